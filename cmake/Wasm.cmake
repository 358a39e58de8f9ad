# The command for WebAssembly: one module that a page, a worker or node instantiates anew for each command line, its files in memory.
# tools/wasm.sh configures it (emcmake) and makes the package of it.
set_target_properties(clast_cli PROPERTIES OUTPUT_NAME clast-core SUFFIX .js)
target_link_options(clast_cli PRIVATE -sMODULARIZE=1 -sEXPORT_NAME=createClast -sENVIRONMENT=web -sINVOKE_RUN=0 -sEXIT_RUNTIME=1
  -sALLOW_MEMORY_GROWTH=1 -sMAXIMUM_MEMORY=2GB -sINITIAL_MEMORY=32MB -sTOTAL_STACK=4MB -sFORCE_FILESYSTEM=1 -sEXPORTED_RUNTIME_METHODS=FS,callMain
  -sSTRICT=0)
target_link_libraries(clast_cli PRIVATE glibc_math) # sin, cbrt and others to the bit
