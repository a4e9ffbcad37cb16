# umbilic: `make demo` shows it at work, `make test` tests it. Both install what they need. `make help` lists the rest.

PYTHON ?= python3
CARGO ?= cargo
CC ?= cc
CXX ?= c++
MESH ?=
BENCH ?=
SANITIZE ?=
SECONDS ?= 60
LANGUAGES ?= node go java csharp lua fortran
TARGETS ?= topology normals curvature segmentation polyline readers differential

LIBRARY := target/release/libumbilic.so
# Where real meshes are found or fetched to; every mesh test reads them from there.
MESHES := target/meshes/meshes
CMAKE_BUILD := target/examples
VENV := target/venv
PAPER_VENV := target/paper-venv
BENCH_TARGET := target/bench

.PHONY: help demo test test-all test-rust test-c test-cpp test-examples test-peers test-ffi time-ffi ffi-packages lint abi sanitize \
  fuzz fuzz-build bench bench-programs bench-instructions bench-hosts accuracy paper pictures header packages clean FORCE

help:
	@echo "make demo [MESH=file]     normals and curvatures of a mesh: tables, PLYs and pictures in target/demo"
	@echo "make test                 every test: Rust, C, C++, command line, peers; installs Debian packages if missing"
	@echo "make test-ffi             bindings for other languages, against C and against mistakes [LANGUAGES=\"go lua\"]"
	@echo "make time-ffi             what a call takes through each of them, and what the library takes of it [MESH=file.off]"
	@echo "make abi                  the binary interface against that of version 0.1.0"
	@echo "make sanitize             C and C++ programs under ASan, LSan, UBSan, TSan and valgrind [SANITIZE=...]"
	@echo "make bench [BENCH=...]    everything against a plain C scatter loop and seven libraries: docs/benchmarks.md"
	@echo "make bench-instructions   instructions that each kernel takes, compared with those that are kept [UPDATE=1]"
	@echo "make bench-hosts          what it costs in C++, OpenMesh, CGAL, Python, ...: docs/hosts.md [MESH=file.off]"
	@echo "make accuracy             every estimator, and other libraries', on known surfaces: docs/accuracy.md"
	@echo "make paper                the paper's tables and figures anew, its claims measured: docs/paper"
	@echo "make pictures             the pictures of the README; scans by umbilic, libigl and VCG: docs/scans.md"
	@echo "make fuzz [SECONDS=60]    hostile input, so long for each target [TARGETS=\"normals readers\"]: target/fuzz/summary.txt"
	@echo "make lint                 rustfmt, clippy, and the links of the documentation"
	@echo "make header               include/umbilic.h anew from src/capi"

# ---- the library, and the program over it ----

$(LIBRARY): FORCE
	$(CARGO) build --release --locked --features cli
	[ -e target/release/libumbilic.so.0 ] || ln -s libumbilic.so target/release/libumbilic.so.0
FORCE:

# ---- demo ----

demo: $(LIBRARY)
	@mkdir -p target/demo
	for example in normals curvature moving; do \
	  $(CC) -std=c99 -O2 -Wall -Wextra -Wpedantic -Werror -Iinclude examples_c/$$example.c -o target/demo/$$example \
	    -Ltarget/release -lumbilic -lm -Wl,-rpath,$(CURDIR)/target/release || exit 1; \
	done
	@echo; echo "The C examples, on meshes of their own:"
	target/demo/normals
	@echo
	target/demo/curvature
	@echo
	target/demo/moving
	@echo; echo "The command line, on $(if $(MESH),$(MESH),a generated mesh):"
	$(if $(MESH),,target/release/umbilic generate bumpy -o target/demo/bumpy.ply --resolution 120)
	target/release/umbilic info $(if $(MESH),"$(MESH)",target/demo/bumpy.ply)
	@echo
	target/release/umbilic normals $(if $(MESH),"$(MESH)",target/demo/bumpy.ply) -o target/demo/normals.ply
	target/release/umbilic render $(if $(MESH),"$(MESH)",target/demo/bumpy.ply) -o target/demo/normals.png
	@echo
	target/release/umbilic curvature $(if $(MESH),"$(MESH)",target/demo/bumpy.ply) -o target/demo/curvature.ply
	target/release/umbilic render $(if $(MESH),"$(MESH)",target/demo/bumpy.ply) -o target/demo/curvature.png --color mean
	@echo; echo "Written: normals and curvature as PLY and PNG in target/demo"

# ---- tests ----

# As many parts at once as there are processors: the library's kernels are compiled by one, for minutes.
JOBS ?= $(shell nproc)

test: packages
	@$(MAKE) --no-print-directory --jobs=$(JOBS) --output-sync=line test-all
	@echo "All tests passed."

test-all: lint test-rust test-c test-cpp test-examples test-peers

# Where the toolchain came without these two, the tests run without them.
lint:
	@if $(CARGO) fmt --version >/dev/null 2>&1; then $(CARGO) fmt --check; \
	  else echo "No rustfmt here: formatting is not checked."; fi
	@if $(CARGO) clippy --version >/dev/null 2>&1; then \
	  $(CARGO) clippy --locked --all-features --all-targets -- -D warnings; \
	  else echo "No clippy here: lints are not checked."; fi
	RUSTDOCFLAGS="-D warnings" $(CARGO) doc --locked --no-deps --lib --quiet

# The tests are linked with the library that ships, so that its kernels, minutes of a core, are compiled once.
test-rust: $(MESHES) $(LIBRARY)
	UMBILIC_MESHES=$(CURDIR)/$(MESHES) UMBILIC_LIBRARY=$(CURDIR)/$(LIBRARY) $(CARGO) test --release --locked --features cli

# The header in every language version that it promises, the C and C++ programs of tests/c, and the README's C.
test-c: $(LIBRARY) | packages
	CC="$(CC)" CXX="$(CXX)" tests/c/test.sh
	sed -n '/^```c$$/,/^```$$/p' README.md | grep -v '^```' > target/c/readme.c
	$(CC) -std=c99 -Wall -Wextra -Wpedantic -Werror -Iinclude -c target/c/readme.c -o target/c/readme.o
	for script in benches/speed/*.py; do \
	  $(PYTHON) -B -c 'import sys; compile(open(sys.argv[1]).read(), sys.argv[1], "exec")' $$script || exit 1; \
	done

# The C++ headers, with OpenMesh, CGAL and Eigen, and the README's C++.
test-cpp: $(LIBRARY) | packages
	CXX="$(CXX)" tests/cpp/test.sh

# The C and C++ examples, OpenMesh and CGAL among them, on real meshes; the benchmarks are compiled.
test-examples: $(LIBRARY) $(MESHES) bench-programs | packages
	cmake -S examples_c -B $(CMAKE_BUILD) -DCMAKE_BUILD_TYPE=Release \
	  -DUMBILIC_INCLUDE_DIR=$(CURDIR)/include -DUMBILIC_LIBRARY=$(CURDIR)/$(LIBRARY)
	cmake --build $(CMAKE_BUILD)
	$(CMAKE_BUILD)/normals
	$(CMAKE_BUILD)/curvature
	$(CMAKE_BUILD)/moving
	$(CMAKE_BUILD)/openmesh_normals $$(tests/peers/list.sh $(MESHES))
	$(CMAKE_BUILD)/openmesh_decimate
	$(CMAKE_BUILD)/openmesh_curvature $$(tests/peers/list.sh $(MESHES))
	$(CMAKE_BUILD)/cgal_normals $$(tests/peers/list.sh $(MESHES))
	$(CMAKE_BUILD)/cgal_curvature $$(tests/peers/list.sh $(MESHES))

# libigl and VCG, from their Python wheels, on real meshes.
test-peers: $(LIBRARY) $(MESHES) $(VENV)/done
	$(VENV)/bin/python -B tests/peers/peers.py $(LIBRARY) $(MESHES)
	$(VENV)/bin/python -B tests/peers/curvature.py $(LIBRARY) $(MESHES)
	$(VENV)/bin/python -B tests/peers/corners.py $(LIBRARY) $(MESHES)

$(VENV)/done: tests/peers/requirements.txt | packages
	$(PYTHON) -m venv $(VENV)
	$(VENV)/bin/pip install --quiet --disable-pip-version-check -r tests/peers/requirements.txt
	touch $@

$(MESHES): | packages
	tests/peers/meshes.sh target/meshes

# ---- other languages ----

# Where npm is there, Node came with it, be it Debian's or another.
FFI_node = $(if $(shell command -v npm),,nodejs npm)
FFI_go := golang-go
FFI_java := default-jdk-headless libjna-java
FFI_csharp := mono-mcs mono-runtime
FFI_lua := luajit
FFI_fortran := gfortran

# The programs of bindings/ on real meshes: the same bits as from C, and a decent answer to every mistake. A minute or two.
test-ffi: $(LIBRARY) $(MESHES) ffi-packages
	CC="$(CC)" $(PYTHON) -B tests/ffi/test.py $(LIBRARY) $(MESHES) $(LANGUAGES)

# Lines of host, quantity, copies, milliseconds of the library, milliseconds of the host.
time-ffi: $(LIBRARY) $(MESHES) ffi-packages
	@CC="$(CC)" $(PYTHON) -B tests/ffi/test.py $(LIBRARY) --time $(if $(MESH),"$(MESH)",$(MESHES)/refined_elephant.off) $(LANGUAGES)

ffi-packages:
	@.ci/packages gcc python3 locales $(foreach language,$(LANGUAGES),$(FFI_$(language)))

# ---- the binary interface ----

# Against version 0.1.0, which is kept in tests/abi. UPDATE=1 keeps today's instead: only until 0.1.0 is released.
abi: $(LIBRARY)
	@.ci/packages gcc abigail-tools
	CC="$(CC)" PYTHON="$(PYTHON)" tests/abi/check.sh $(LIBRARY) $(if $(UPDATE),update)

# ---- sanitizers ----

SANITIZE_PACKAGES := gcc g++ valgrind

# The C and C++ programs under each of them, after faults on purpose: SANITIZE=... runs some of address, undefined, thread,
# memcheck and helgrind.
sanitize: $(LIBRARY)
	@.ci/packages $(SANITIZE_PACKAGES)
	CC="$(CC)" CXX="$(CXX)" CARGO="$(CARGO)" tests/c/sanitize.sh $(SANITIZE)

# ---- Debian packages ----

PACKAGES := gcc g++ clang binutils cmake libopenmesh-dev libcgal-dev libeigen3-dev python3-venv

packages:
	@.ci/packages $(PACKAGES)

# ---- benchmark ----

# What Open3D's wheel needs.
BENCH_PACKAGES := libusb-1.0-0

# What is not to be had is left out, with a line that says so: some ten minutes.
bench:
	@.ci/packages $(PACKAGES) $(BENCH_PACKAGES) || echo "Not all packages are to be had."
	$(MAKE) --no-print-directory bench-programs $(BENCH_TARGET)/venv/done
	$(BENCH_TARGET)/venv/bin/python -B benches/speed/speed.py $(BENCH)

bench-instructions:
	@.ci/packages gcc g++ cmake valgrind
	$(MAKE) --no-print-directory bench-programs
	$(PYTHON) -B benches/speed/instructions.py $(if $(UPDATE),--update)

bench-programs: $(LIBRARY)
	cmake -S benches/speed -B $(BENCH_TARGET)/build -DUMBILIC_LIBRARY=$(CURDIR)/$(LIBRARY)
	cmake --build $(BENCH_TARGET)/build

$(BENCH_TARGET)/venv/done: benches/speed/requirements.txt benches/speed/peers.txt
	$(PYTHON) -m venv $(BENCH_TARGET)/venv
	$(BENCH_TARGET)/venv/bin/pip install --quiet --disable-pip-version-check -r benches/speed/requirements.txt
	while read -r peer; do \
	  $(BENCH_TARGET)/venv/bin/pip install --quiet --disable-pip-version-check "$$peer" || \
	    echo "$$peer is not to be had: not compared with"; \
	done < benches/speed/peers.txt
	touch $@

# ---- hosts ----

HOSTS := target/hosts

# What umbilic costs in each host: MeshLab and other languages are there once their tests have been run.
bench-hosts: $(LIBRARY) $(MESHES) | packages
	@mkdir -p $(HOSTS)
	for host in structs openmesh cgal; do \
	  $(CXX) -std=c++17 -O2 -DNDEBUG -Wall -Wextra -Wpedantic -Werror -Iinclude benches/hosts/$$host.cpp -o $(HOSTS)/$$host \
	    -Ltarget/release -lumbilic -lOpenMeshCore -lgmp -lmpfr -Wl,-rpath,$(CURDIR)/target/release || exit 1; \
	done
	$(PYTHON) -B benches/hosts/hosts.py $(if $(MESH),"$(MESH)",$(MESHES)/refined_elephant.off)

# ---- accuracy ----

ACCURACY := target/accuracy

# Every estimator, and those of other libraries as far as they are there: some minutes.
accuracy: $(LIBRARY) $(ACCURACY)/venv/done | packages
	cmake -S benches/accuracy/cpp -B $(ACCURACY)/peers -DCMAKE_BUILD_TYPE=Release
	cmake --build $(ACCURACY)/peers
	$(ACCURACY)/venv/bin/python -B benches/accuracy/check.py
	$(ACCURACY)/venv/bin/python -B benches/accuracy/convergence.py $(LIBRARY)
	$(ACCURACY)/venv/bin/python -B benches/accuracy/leaderboard.py $(LIBRARY) --peers $(ACCURACY)/peers

$(ACCURACY)/venv/done: benches/accuracy/requirements.txt benches/accuracy/peers.txt | packages
	$(PYTHON) -m venv $(ACCURACY)/venv
	$(ACCURACY)/venv/bin/pip install --quiet --disable-pip-version-check -r benches/accuracy/requirements.txt
	while read -r peer; do \
	  $(ACCURACY)/venv/bin/pip install --quiet --disable-pip-version-check "$$peer" || \
	    echo "$$peer is not to be had: not compared with"; \
	done < benches/accuracy/peers.txt
	touch $@

# ---- the paper's tables and figures ----

# Fails if a printed digit of the tables that reproduce does not come out.
paper: $(LIBRARY) $(PAPER_VENV)/done
	$(PAPER_VENV)/bin/python -B benches/paper/paper.py $(LIBRARY)
	$(PAPER_VENV)/bin/python -B benches/paper/check_digits.py $(LIBRARY)

$(PAPER_VENV)/done: benches/paper/requirements.txt
	@.ci/packages python3-venv
	$(PYTHON) -m venv $(PAPER_VENV)
	$(PAPER_VENV)/bin/pip install --quiet --disable-pip-version-check -r benches/paper/requirements.txt
	touch $@

# ---- pictures ----

# Those of the README, and docs/scans.md: some two minutes.
pictures: $(LIBRARY) $(MESHES) $(VENV)/scans
	target/release/umbilic render $(MESHES)/elephant.off -o docs/elephant.png --color mean --size 640x560 --azimuth -10
	target/release/umbilic render $(MESHES)/fandisk.off -o docs/fandisk.png --color k1 --size 640x560
	target/release/umbilic segment $(MESHES)/fandisk.off --picture docs/fandisk_faces.png --size 320x280
	target/release/umbilic segment $(MESHES)/anchor_dense.off --picture docs/anchor_faces.png --size 320x280
	target/release/umbilic segment $(MESHES)/fandisk.off --by regions --smallest-share 0.002 --picture docs/fandisk_regions.png \
	  --size 320x280
	target/release/umbilic segment $(MESHES)/elephant.off --by watershed --picture docs/elephant_basins.png --size 320x280 \
	  --azimuth -10
	$(VENV)/bin/python -B benches/scans/scans.py $(LIBRARY) $(MESHES)

$(VENV)/scans: benches/scans/requirements.txt $(VENV)/done
	$(VENV)/bin/pip install --quiet --disable-pip-version-check -r benches/scans/requirements.txt
	touch $@

# ---- fuzzing ----

FUZZ := target/fuzz
# Much as cargo-fuzz has it, but with any toolchain, and so that the kernels compile in minutes: comparisons are not traced, since
# there are few magic numbers to find; the standard library does not check its own unsafe code in every loop; and what lies on the
# stack is left unguarded, since what callers hand in lies in the heap.
FUZZ_FLAGS := -Zsanitizer=address --cfg fuzzing -Zub-checks=no -Cpasses=sancov-module \
  $(addprefix -Cllvm-args=-,sanitizer-coverage-level=2 sanitizer-coverage-inline-8bit-counters \
  sanitizer-coverage-pc-table asan-stack=0 asan-use-after-scope=0)
HOST = $(shell rustc -vV | sed -n 's/^host: //p')

fuzz: fuzz-build
	$(FUZZ)/build/$(HOST)/release/examples/seeds fuzz/corpus
	fuzz/run.sh $(SECONDS) $(FUZZ)/build/$(HOST)/release fuzz/corpus $(FUZZ) $(TARGETS)

fuzz-build:
	@.ci/packages gcc g++
	RUSTC_BOOTSTRAP=1 RUSTFLAGS="$(FUZZ_FLAGS)" $(CARGO) build --manifest-path fuzz/Cargo.toml --locked --release \
	  --target $(HOST) --target-dir $(FUZZ)/build --bins --examples

header:
	UPDATE_HEADER=1 $(CARGO) test --test header

clean:
	$(CARGO) clean
