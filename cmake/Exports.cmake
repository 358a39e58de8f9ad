# What libclast exports: its interface, and under a name of this release what it shares with its view (src/base/status.h):
# cmake -DOUT=libclast.map -DINTERFACE=0.2 -DVERSION=0.2.0 -DHEADERS="a;b" -P Exports.cmake
set(shared)
foreach(header ${HEADERS})
  file(STRINGS ${header} marks REGEX "^CLX_SHARED ")
  list(TRANSFORM marks REPLACE "^[^(]*(clx_[a-z0-9_]+)\\(.*" "\\1")
  list(APPEND shared ${marks})
endforeach()
list(JOIN shared "; " shared)
file(WRITE ${OUT} "CLAST_${INTERFACE} { global: clast_*; local: *; };\nCLAST_PRIVATE_${VERSION} { global: ${shared}; };\n")
