"""Takes from a description of the interface what structs have gained at their end since an older one.

Structs that start with their size may grow: the library reads and writes as much of them as a program's size says. abidiff has a
rule for that, but it also lets pass fields that change places or types. So the fields beyond the older size are taken away here, and
abidiff then has to find everything else unchanged.

Usage: without_new_fields.py OLD NEW, both as abidw writes them; the result goes to standard output.
"""

import sys
import xml.etree.ElementTree as ET


def members(struct):
    """The data members of a struct, as pairs of element and offset in bits."""
    return [(member, int(member.get("layout-offset-in-bits"))) for member in struct.findall("data-member")]


def starts_with_size(struct):
    first = struct.find("data-member/var-decl")
    return first is not None and first.get("name") == "struct_size"


old, new = (ET.parse(path) for path in sys.argv[1:3])
sizes = {struct.get("name"): int(struct.get("size-in-bits")) for struct in old.iter("class-decl") if starts_with_size(struct)}
for struct in new.iter("class-decl"):
    size = sizes.get(struct.get("name"))
    if size is None or int(struct.get("size-in-bits")) <= size:
        continue
    struct.set("size-in-bits", str(size))
    for member, offset in members(struct):
        if offset >= size:
            struct.remove(member)
new.write(sys.stdout, encoding="unicode")
