// Debian's archives are compiled for programs (-fPIE): they read the standard streams in place,
// which libc's shared object does not offer to another. The bundled library gives them pointers of
// its own, to the same streams. No <stdio.h>: it declares them otherwise.
#define HIDDEN __attribute__((visibility("hidden")))

// NOLINTBEGIN(bugprone-reserved-identifier,cert-dcl37-c,cert-dcl51-cpp)
extern char _IO_2_1_stdin_[];
extern char _IO_2_1_stdout_[];
extern char _IO_2_1_stderr_[];

extern HIDDEN void *stdin;
extern HIDDEN void *stdout;
extern HIDDEN void *stderr;

HIDDEN void *stdin = _IO_2_1_stdin_;
HIDDEN void *stdout = _IO_2_1_stdout_;
HIDDEN void *stderr = _IO_2_1_stderr_;
// NOLINTEND(bugprone-reserved-identifier,cert-dcl37-c,cert-dcl51-cpp)
