# clast: the everyday commands. CMake does the building; this file names what people type.
.PHONY: all dev release quick test demo bench paper docs format install clean setup
all: dev

setup: ; @tools/setup.sh build
dev release tsan coverage minimal fuzz:
	@tools/build.sh $@
quick: dev
	@ctest --test-dir build/dev -j2 --output-on-failure
install: release
	@cmake --install build/release
format:
	@clang-format-14 -i $$(git ls-files '*.c' '*.h' '*.def')
clean: ; rm -rf build
