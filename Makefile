# clast: what people type. CMake does the building (CMakePresets.json); tools/ holds the longer steps.
.PHONY: all dev release mpi tsan coverage minimal fuzz fuzz-commands faults afl quick test demo bench paper paper-aggregate paper-predict paper-shape paper-d2sd paper-packing example-code-saturne golden docs format hooks dist tarball wheel deb packages test-i386 wasm bare install uninstall clean
all: dev

# The group of tools/setup.sh that a target's tools are in.
release: group = build
dev coverage minimal: group = dev
tsan: group = clang
mpi: group = mpi
dev release tsan coverage minimal mpi:
	@tools/setup.sh $(group)
	@tools/build.sh $@
quick: dev # every test under sanitizers
	@ctest --test-dir build/dev -j2 --output-on-failure --no-tests=error
test:
	@command -v bash >/dev/null && tools/test.sh
demo:
	@tools/demo.sh
install:
	@tools/setup.sh build
	@tools/build.sh release installed
	@cmake --install build/release $(if $(PREFIX),--prefix $(PREFIX))
uninstall: # what the last `make install` laid down, and the folders of clast's own
	@[ -e build/release/install_manifest.txt ] || { echo "uninstall: build/release/install_manifest.txt is missing: nothing was installed from here"; exit 1; }
	@sed 's,^,$(DESTDIR),' build/release/install_manifest.txt | xargs -d '\n' rm -f
	@sed -n 's,/[^/]*$$,,;s,^\(.*/clast\)$$,$(DESTDIR)\1,p' build/release/install_manifest.txt | sort -u | xargs -d '\n' -r rmdir --ignore-fail-on-non-empty
	@rm build/release/install_manifest.txt
fuzz:
	@tools/setup.sh clang
	@tools/fuzz.sh
fuzz-commands:
	@tools/setup.sh dev
	@tools/build.sh release clast_cli
	@tests/fuzz/fuzz_commands.py --runs $(or $(RUNS),80000)
	@tools/build.sh dev clast_cli
	@tests/fuzz/fuzz_commands.py --clast build/dev/clast --limit 60 --memory 4e9 --first 1000000 --runs $(or $(RUNS),20000)
faults:
	@tools/setup.sh dev
	@tools/build.sh release clast_cli
	@tests/fuzz/fault_commands.py --kills 1000
afl:
	@tools/setup.sh afl
	@tools/afl.sh
docs:
	@tools/setup.sh docs
	@tools/docs.sh
bench:
	@tools/setup.sh dev
	@tools/bench.sh
paper: paper-aggregate paper-predict paper-shape paper-d2sd paper-packing
paper-aggregate:
	@tools/setup.sh paper
	@tools/build.sh release clast_cli
	@tools/paper_aggregate.py
paper-predict:
	@tools/setup.sh paper
	@tools/build.sh release clast_cli
	@tools/paper_predict.py
paper-shape:
	@tools/setup.sh paper
	@tools/build.sh release clast_cli
	@tools/paper_shape.py
paper-d2sd:
	@tools/setup.sh paper
	@tools/build.sh release
	@tools/paper_d2sd.py
	@CLAST_POINTS=1200000 build/release/tests/property_test_decompose_threads
paper-packing:
	@tools/setup.sh paper
	@tools/build.sh release clast_cli clast_view
	@tools/paper_packing.py
example-code-saturne:
	@tools/setup.sh saturne
	@tools/build.sh release libclast.so libclast_view.so libclast_mpi.so
	@examples/code_saturne/drive.py
golden: dev
	@CLAST_RENEW_GOLDEN=1 ctest --test-dir build/dev -R 'test_golden|test_transcripts' --output-on-failure --no-tests=error
	@[ ! -e .git ] || git diff --stat tests/golden
format:
	@tools/setup.sh format
	@tools/list_files.sh '*.c' '*.h' | xargs -0 clang-format-14 -i
hooks:
	@[ -e .git ] || { echo "hooks: this is no git clone"; exit 1; }
	@tools/setup.sh hooks
	@git config core.hooksPath tools/hooks
dist:
	@tools/setup.sh dist
	@tools/dist.sh
tarball:
	@tools/setup.sh bundle
	@tools/tarball.sh
wheel:
	@tools/setup.sh bundle
	@tools/wheel.sh
deb:
	@tools/setup.sh deb
	@tools/deb.sh
packages: tarball wheel deb
	@tools/check_packages.sh
test-i386:
	@tools/setup.sh i386
	@tools/test_i386.sh
wasm:
	@tools/setup.sh wasm
	@tools/build.sh release clast_cli
	@tools/wasm.sh
bare:
	@tools/check_bare.sh
clean:
	rm -rf build
