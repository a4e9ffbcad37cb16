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
# Wherever the environment has cargo put things.
export CARGO_TARGET_DIR := target
# Where real meshes are found or fetched to; every mesh test reads them from there.
MESHES := target/meshes/meshes
CMAKE_BUILD := target/examples
VENV := target/venv
PAPER_VENV := target/paper-venv
BENCH_TARGET := target/bench
# Manual pages and completions.
PROGRAM_DATA := target/program

.PHONY: help demo build test test-all test-rust test-c test-cpp test-examples test-peers test-packages test-python test-ffi time-ffi \
  ffi-packages meshlab-plugin test-meshlab lint abi sanitize fuzz fuzz-build bench bench-programs bench-instructions bench-hosts \
  accuracy paper pictures header install uninstall deb dist dist-check packages clean FORCE

help:
	@echo "make demo [MESH=file]     normals and curvatures of a mesh: tables, PLYs and pictures in target/demo"
	@echo "make test                 every test: Rust, C, C++, Python, command line, peers, packages; installs what is missing"
	@echo "make build                the library, and the program over it"
	@echo "make install              what is built, to PREFIX=/usr/local below DESTDIR=; make uninstall takes it away"
	@echo "make deb                  Debian packages of what is built: target/debian"
	@echo "make dist                 a source archive that builds offline: target/dist; make dist-check builds it"
	@echo "make test-python          the Python package, part of make test: a wheel, its tests, examples, types and pictures"
	@echo "make meshlab-plugin       filters for Debian's MeshLab: bindings/meshlab/README.md; make test-meshlab tests them"
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

build: $(LIBRARY)
	@$(MAKE) --no-print-directory $(PROGRAM_DATA)/done

# cargo links with cc.
$(LIBRARY): FORCE
	@command -v cc >/dev/null || .ci/packages gcc
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

# As many parts at once as there are processors: the library's kernels are compiled by one, for minutes. What they need is installed before,
# once.
JOBS ?= $(shell nproc)

test:
	@.ci/packages $(PACKAGES) $(PACKAGING_PACKAGES) $(PYTHON_PACKAGES)
	@$(MAKE) --no-print-directory --jobs=$(JOBS) --output-sync=line test-all
	@echo "All tests passed."

test-all: lint test-rust test-c test-cpp test-examples test-peers test-packages test-python

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

EXAMPLES_WRITE := $(CMAKE_BUILD)/written
# Of these each edge has two faces at most, and no face is without area.
PARTS := $(addprefix $(MESHES)/,fandisk.off anchor_dense.off elephant.off polygon_mesh.off)

# The C and C++ examples, OpenMesh and CGAL among them, on real meshes, and what they write is read; the benchmarks are compiled.
test-examples: $(LIBRARY) $(MESHES) bench-programs | packages
	cmake -S examples_c -B $(CMAKE_BUILD) -DCMAKE_BUILD_TYPE=Release \
	  -DUMBILIC_INCLUDE_DIR=$(CURDIR)/include -DUMBILIC_LIBRARY=$(CURDIR)/$(LIBRARY)
	+cmake --build $(CMAKE_BUILD)
	$(CMAKE_BUILD)/normals
	$(CMAKE_BUILD)/curvature
	$(CMAKE_BUILD)/moving
	for example in openmesh_normals openmesh_curvature openmesh_parts cgal_normals cgal_curvature cgal_parts; do \
	  case $$example in *_parts) meshes="$(PARTS)" ;; *) meshes=$$(tests/peers/list.sh $(MESHES)) ;; esac; \
	  rm -rf $(EXAMPLES_WRITE) && mkdir $(EXAMPLES_WRITE) && $(CMAKE_BUILD)/$$example -o $(EXAMPLES_WRITE) $$meshes || exit 1; \
	  for written in $(EXAMPLES_WRITE)/*.ply; do target/release/umbilic info $$written > /dev/null || exit 1; done; \
	done
	$(CMAKE_BUILD)/openmesh_decimate

# libigl and VCG, from their Python wheels, on real meshes.
test-peers: $(LIBRARY) $(MESHES) $(VENV)/done
	$(VENV)/bin/python -B tests/peers/peers.py $(MESHES)
	$(VENV)/bin/python -B tests/peers/curvature.py $(MESHES)
	$(VENV)/bin/python -B tests/peers/corners.py $(MESHES)

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

# ---- MeshLab ----

MESHLAB := target/meshlab
MESHLAB_TESTS := OFF
# meshlab is what loads the plugin, dpkg-dev unpacks its source.
MESHLAB_PACKAGES := g++ cmake dpkg-dev meshlab qtbase5-dev libqt5opengl5-dev libglew-dev libeigen3-dev

# The plugin, for the MeshLab of Debian: bindings/meshlab/README.md says how it gets there.
meshlab-plugin: $(LIBRARY)
	@.ci/packages $(MESHLAB_PACKAGES)
	cmake -S bindings/meshlab -B $(MESHLAB)/build -DMESHLAB_SOURCE="$$(bindings/meshlab/source.sh $(MESHLAB))" \
	  -DUMBILIC_MESHLAB_TESTS=$(MESHLAB_TESTS)
	+cmake --build $(MESHLAB)/build

# Its filters in process, and in an unmodified meshlabserver.
test-meshlab: MESHLAB_TESTS := ON
test-meshlab: meshlab-plugin $(MESHES) $(MESHLAB)/venv/done
	@.ci/packages binutils xvfb xauth
	bindings/meshlab/tests/test.sh $(MESHLAB)/venv/bin/python $(MESHES)

$(MESHLAB)/venv/done: bindings/meshlab/tests/requirements.txt | packages
	$(PYTHON) -m venv $(MESHLAB)/venv
	$(MESHLAB)/venv/bin/pip install --quiet --disable-pip-version-check -r bindings/meshlab/tests/requirements.txt
	touch $@

# ---- installation ----

PREFIX ?= /usr/local
DESTDIR ?=
BINDIR ?= $(PREFIX)/bin
LIBDIR ?= $(PREFIX)/lib
INCLUDEDIR ?= $(PREFIX)/include
DATADIR ?= $(PREFIX)/share
MANDIR ?= $(DATADIR)/man
PKGCONFIGDIR ?= $(LIBDIR)/pkgconfig
CMAKEDIR ?= $(LIBDIR)/cmake/umbilic
BASHCOMPLETIONDIR ?= $(DATADIR)/bash-completion/completions
ZSHCOMPLETIONDIR ?= $(DATADIR)/zsh/site-functions
FISHCOMPLETIONDIR ?= $(DATADIR)/fish/vendor_completions.d

VERSION := $(shell sed -n 's/^version = "\(.*\)"$$/\1/p' Cargo.toml)
ABI := $(shell sed -n 's/^#define UMB_ABI_VERSION //p' include/umbilic.h)
HEADERS := $(patsubst include/%,%,$(wildcard include/*.h include/*.hpp include/umbilic/*.hpp))
# A page for the program, and one for each command, which has a file of its own.
MANUAL := umbilic.1 $(patsubst src/bin/umbilic/commands/%.rs,umbilic-%.1,$(filter-out %/mod.rs,$(wildcard src/bin/umbilic/commands/*.rs)))

# Every file that is installed, as mode:file:place.
INSTALLED := \
  755:target/release/umbilic:$(BINDIR)/umbilic \
  755:$(LIBRARY):$(LIBDIR)/libumbilic.so.$(VERSION) \
  644:target/release/libumbilic.a:$(LIBDIR)/libumbilic.a \
  $(foreach header,$(HEADERS),644:include/$(header):$(INCLUDEDIR)/$(header)) \
  644:bindings/pkg-config/umbilic.pc.in:$(PKGCONFIGDIR)/umbilic.pc \
  644:cmake/umbilicConfig.cmake.in:$(CMAKEDIR)/umbilicConfig.cmake \
  644:cmake/umbilicConfigVersion.cmake.in:$(CMAKEDIR)/umbilicConfigVersion.cmake \
  $(foreach page,$(MANUAL),644:$(PROGRAM_DATA)/$(page):$(MANDIR)/man1/$(page)) \
  644:$(PROGRAM_DATA)/umbilic.bash:$(BASHCOMPLETIONDIR)/umbilic \
  644:$(PROGRAM_DATA)/umbilic.zsh:$(ZSHCOMPLETIONDIR)/_umbilic \
  644:$(PROGRAM_DATA)/umbilic.fish:$(FISHCOMPLETIONDIR)/umbilic.fish
LIBRARY_LINKS := $(LIBDIR)/libumbilic.so.$(ABI) $(LIBDIR)/libumbilic.so

# The way from one directory to another: so what is installed can be moved as a whole. Not below /usr, which pkg-config has to recognise
# in order to leave out directories that compilers search anyway.
way = $(shell realpath -ms --relative-to="$(1)" "$(2)")
pkgconfig_prefix = $(if $(filter /usr /usr/,$(PREFIX)),/usr,$${pcfiledir}/$(call way,$(PKGCONFIGDIR),$(PREFIX)))
fill_in = sed -i -e 's|@VERSION@|$(VERSION)|; s|@ABI@|$(ABI)|; s|@PREFIX@|$(1)|' \
  -e 's|@LIBDIR@|$(call way,$(PREFIX),$(LIBDIR))|; s|@INCLUDEDIR@|$(call way,$(PREFIX),$(INCLUDEDIR))|'

# Lists are cut at blanks, and a path that is not absolute would be taken from here: neither is installed anywhere at all.
DIRECTORIES := PREFIX BINDIR LIBDIR INCLUDEDIR DATADIR MANDIR PKGCONFIGDIR CMAKEDIR BASHCOMPLETIONDIR ZSHCOMPLETIONDIR FISHCOMPLETIONDIR
is_directory = $(and $(filter 1,$(words $(1))),$(filter /%,$(1)))
check_directories = $(foreach name,$(DIRECTORIES),$(if $(call is_directory,$($(name))),,$(error $(name)="$($(name))" is no absolute path without blanks)))

# What is built is installed as it is, so that root needs no cargo; but without the standard library's debug information, two thirds of the
# archive.
install: | target/release/umbilic $(PROGRAM_DATA)/done
	$(check_directories)
	@set -e; for entry in $(INSTALLED); do \
	  IFS=:; set -- $$entry; echo "install $(DESTDIR)$$3"; install -D -m "$$1" "$$2" "$(DESTDIR)$$3"; \
	done
	$(call fill_in,$(pkgconfig_prefix)) "$(DESTDIR)$(PKGCONFIGDIR)/umbilic.pc"
	$(call fill_in,$(call way,$(CMAKEDIR),$(PREFIX))) "$(DESTDIR)$(CMAKEDIR)/umbilicConfig.cmake" "$(DESTDIR)$(CMAKEDIR)/umbilicConfigVersion.cmake"
	strip --strip-debug "$(DESTDIR)$(LIBDIR)/libumbilic.a"
	for link in $(LIBRARY_LINKS); do ln -sf libumbilic.so.$(VERSION) "$(DESTDIR)$$link" || exit 1; done
	$(if $(DESTDIR),,if [ "$$(id -u)" -eq 0 ]; then ldconfig; fi)

uninstall:
	$(check_directories)
	@for entry in $(INSTALLED) $(LIBRARY_LINKS); do echo "remove $(DESTDIR)$${entry##*:}"; rm -f "$(DESTDIR)$${entry##*:}" || exit 1; done
	for directory in $(INCLUDEDIR)/umbilic $(CMAKEDIR); do \
	  if [ -d "$(DESTDIR)$$directory" ]; then rmdir --ignore-fail-on-non-empty "$(DESTDIR)$$directory" || exit 1; fi; \
	done
	$(if $(DESTDIR),,if [ "$$(id -u)" -eq 0 ]; then ldconfig; fi)

target/release/umbilic:
	$(MAKE) --no-print-directory $(LIBRARY)

$(PROGRAM_DATA)/done: target/release/umbilic
	rm -rf $(PROGRAM_DATA)
	mkdir -p $(PROGRAM_DATA)
	target/release/umbilic man $(PROGRAM_DATA)
	for shell in bash zsh fish; do target/release/umbilic completions $$shell > $(PROGRAM_DATA)/umbilic.$$shell || exit 1; done
	touch $@

# ---- source archive ----

NAME := umbilic-$(VERSION)

# The committed files and the crates that they ask for: the same commit gives the same bytes.
dist:
	@.ci/packages git
	rm -rf target/dist
	mkdir -p target/dist
	git archive --prefix=$(NAME)/ HEAD | tar --extract --directory=target/dist
	mkdir target/dist/$(NAME)/.cargo
	cd target/dist/$(NAME) && $(CARGO) vendor --locked --sync fuzz/Cargo.toml vendor > .cargo/config.toml
	tar --create --file=target/dist/$(NAME).tar.gz --use-compress-program="gzip --no-name" --directory=target/dist --format=gnu \
	  --sort=name --mtime="$$(git log -1 --format=@%ct)" --owner=0 --group=0 --numeric-owner --mode=u+rw,go+r-w,a+X $(NAME)
	rm -r target/dist/$(NAME)

# The archive, built and installed by someone who has nothing else: as long as any first build.
dist-check:
	MAKE="$(MAKE)" CARGO="$(CARGO)" tests/consumers/archive.sh build

# ---- Debian packages of umbilic ----

DEBIAN := target/debian
export DEBFULLNAME ?= The umbilic developers
export DEBEMAIL ?= umbilic@localhost
# The project has no mail address, and nobody has asked Debian for it.
LINTIAN := lintian --fail-on error --suppress-tags bogus-mail-host,bogus-mail-host-in-debian-changelog,initial-upload-closes-no-bugs

# Of what is built.
deb: | target/release/umbilic $(PROGRAM_DATA)/done
	@.ci/packages dpkg-dev debhelper lintian
	rm -rf $(DEBIAN)
	mkdir -p $(DEBIAN)/$(NAME)
	cp -r bindings/debian $(DEBIAN)/$(NAME)/debian
	sed -i -e 's/@VERSION@/$(VERSION)/' -e "s/@DATE@/$$(date -R -r CHANGELOG.md)/" \
	  -e "s|@MAINTAINER@|$$DEBFULLNAME <$$DEBEMAIL>|" $(DEBIAN)/$(NAME)/debian/control $(DEBIAN)/$(NAME)/debian/changelog
	cd $(DEBIAN)/$(NAME) && SOURCE="$(CURDIR)" dpkg-buildpackage --build=binary --no-sign --no-check-builddeps
	$(LINTIAN) $(if $(filter 0,$(shell id -u)),--allow-root) $(DEBIAN)/*.changes

test-packages: $(LIBRARY)
	@.ci/packages $(PACKAGES) $(PACKAGING_PACKAGES)
	MAKE="$(MAKE)" CC="$(CC)" CXX="$(CXX)" tests/consumers/test.sh
	MAKE="$(MAKE)" CARGO="$(CARGO)" tests/consumers/archive.sh

# ---- the Python package ----

PYTHON_TARGET := target/python
PYTHON_VENV := $(PYTHON_TARGET)/venv
# What pyvista draws with, off-screen.
PYTHON_PACKAGES := gcc python3-venv libegl1 libgl1 libxrender1

# The wheel holds the library as it is built, and is all that the tests see of the package.
test-python: $(LIBRARY) $(MESHES) $(PYTHON_VENV)/done
	rm -rf $(PYTHON_TARGET)/wheel
	UMBILIC_LIBRARY=$(CURDIR)/$(LIBRARY) $(PYTHON_VENV)/bin/pip wheel --quiet --disable-pip-version-check --no-deps \
	  --wheel-dir $(PYTHON_TARGET)/wheel ./bindings/python
	$(PYTHON_VENV)/bin/pip install --quiet --disable-pip-version-check --force-reinstall --no-deps $(PYTHON_TARGET)/wheel/*.whl
	cd bindings/python && unset PYTHONPATH UMBILIC_LIBRARY && bin=$(CURDIR)/$(PYTHON_VENV)/bin && \
	  $$bin/python -B -m pytest -q -p no:cacheprovider tests && \
	  $$bin/python -B -m pytest -q -p no:cacheprovider --doctest-modules --pyargs umbilic && \
	  $$bin/mypy --cache-dir $(CURDIR)/$(PYTHON_TARGET)/mypy && \
	  $$bin/python -B gallery.py $(CURDIR)/$(PYTHON_TARGET)/gallery $(CURDIR)/$(MESHES)/fandisk.off

$(PYTHON_VENV)/done: bindings/python/tests/requirements.txt
	@.ci/packages $(PYTHON_PACKAGES)
	rm -rf $(PYTHON_VENV)
	$(PYTHON) -m venv $(PYTHON_VENV)
	$(PYTHON_VENV)/bin/pip install --quiet --disable-pip-version-check -r bindings/python/tests/requirements.txt
	touch $@

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

# What packaging needs besides, and its tests.
PACKAGING_PACKAGES := git dpkg-dev debhelper lintian pkg-config man-db bash-completion

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
	+cmake --build $(BENCH_TARGET)/build

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
	+cmake --build $(ACCURACY)/peers
	$(ACCURACY)/venv/bin/python -B benches/accuracy/check.py
	$(ACCURACY)/venv/bin/python -B benches/accuracy/convergence.py
	$(ACCURACY)/venv/bin/python -B benches/accuracy/leaderboard.py --peers $(ACCURACY)/peers

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
	$(PAPER_VENV)/bin/python -B benches/paper/paper.py
	$(PAPER_VENV)/bin/python -B benches/paper/check_digits.py

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
	$(VENV)/bin/python -B benches/scans/scans.py $(MESHES)

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
