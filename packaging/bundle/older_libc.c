// What Debian 12's libexpat calls of its libc, and the one of Ubuntu 22.04 does not have: with this
// a bundled clast starts there too.
#include <stddef.h>
#include <stdlib.h>
#include <sys/random.h>

void arc4random_buf(void *to, size_t n);
/// Random bytes of the kernel, for the salt of libexpat's tables; as libc's own it ends the process
/// where the kernel gives none.
void arc4random_buf(void *to, size_t n)
{
    unsigned char *at = to;
    while (n > 0) {
        const ssize_t given = getrandom(at, n, 0);
        if (given <= 0) {
            abort();
        }
        at += given;
        n -= (size_t)given;
    }
}

// hypot got a new version in libc 2.35, which only leaves errno alone; the old one gives the same
// numbers there. The linker sends all calls here (--wrap).
__asm__(".symver any_hypot, hypot@GLIBC_2.2.5");
double any_hypot(double x, double y);
// NOLINTBEGIN(bugprone-reserved-identifier,cert-dcl37-c,cert-dcl51-cpp)
double __wrap_hypot(double x, double y);
double __wrap_hypot(double x, double y)
{
    return any_hypot(x, y);
}
// NOLINTEND(bugprone-reserved-identifier,cert-dcl37-c,cert-dcl51-cpp)
