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
