#!/usr/bin/env python3
"""Fails if a printed digit of the paper's tables 1 and 3 does not come out, or one that is said not to does.

python3 benches/paper/check_digits.py

Needs numpy only.
"""

import sys

import printed
import table_1
import table_3
from library import Library


def failures(library):
    for count, found in table_1.curvatures(library).items():
        mine, theirs = table_1.digits(found["P"]), printed.TABLE_1[count]
        if mine != theirs:
            yield f"table 1, n = {count}: {' and '.join(mine)}, the paper has {' and '.join(theirs)}"
    found = table_3.errors(library)
    for name, theirs in printed.TABLE_3.items():
        for their, (count, error) in zip(theirs, found[name].items()):
            mine, known = printed.six_decimals(error), (name, count) in printed.OPEN_CELLS
            if (mine == their) == known:
                says = "which is said not to reproduce" if known else "the paper has " + their
                yield f"table 3, {name} at {count} vertices: {mine}, {says}"


def main(arguments):
    if arguments:
        sys.exit("usage: check_digits.py")
    found = list(failures(Library()))
    if found:
        sys.exit("\n".join(found))
    cells = sum(map(len, printed.TABLE_3.values())) - len(printed.OPEN_CELLS)
    print(f"The paper's tables: {2 * len(printed.TABLE_1)} figures of table 1 and {cells} of table 3 as printed.")


if __name__ == "__main__":
    main(sys.argv[1:])
