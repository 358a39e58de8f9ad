# clast: what people type. CMake does the building (CMakePresets.json); tools/ holds the longer steps.
.PHONY: all dev release mpi tsan coverage minimal fuzz afl quick test demo bench paper paper-aggregate paper-predict paper-shape paper-d2sd paper-packing golden docs format hooks install clean
all: dev

dev release tsan coverage minimal:
	@tools/setup.sh build
	@tools/build.sh $@
mpi:
	@tools/setup.sh mpi
	@tools/build.sh $@
quick: dev
	@ctest --test-dir build/dev -j2 --output-on-failure
test:
	@command -v bash >/dev/null && tools/test.sh
demo:
	@tools/demo.sh
install: release
	@cmake --install build/release $(if $(PREFIX),--prefix $(PREFIX))
fuzz:
	@tools/fuzz.sh
afl:
	@tools/setup.sh build
	@tools/afl.sh
docs:
	@tools/docs.sh
bench:
	@tools/setup.sh build
	@tools/bench.sh
paper: paper-aggregate paper-predict paper-shape paper-d2sd paper-packing
paper-aggregate:
	@tools/setup.sh build
	@tools/build.sh release clast_cli
	@tools/paper_aggregate.py
paper-predict:
	@tools/setup.sh build
	@tools/build.sh release clast_cli
	@tools/paper_predict.py
paper-shape:
	@tools/setup.sh build
	@tools/build.sh release clast_cli
	@tools/paper_shape.py
paper-d2sd:
	@tools/setup.sh build
	@tools/build.sh release
	@tools/paper_d2sd.py
	@CLAST_POINTS=1200000 build/release/tests/property_test_decompose_threads
paper-packing:
	@tools/setup.sh build
	@tools/build.sh release clast_cli clast
	@tools/paper_packing.py
golden: dev
	@CLAST_RENEW_GOLDEN=1 build/dev/tests/golden_test_golden
	@git diff --stat tests/golden
format:
	@clang-format-14 -i $$(git ls-files '*.c' '*.h')
hooks:
	@git config core.hooksPath tools/hooks
clean:
	rm -rf build
