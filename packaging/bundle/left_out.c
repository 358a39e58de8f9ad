// What Debian's archives call and a bundled clast leaves out: packings of TIFF that clast refuses
// anyway (libjbig is under the GPL, libLerc is C++, the rest would only be carried), and the
// Fortran run time, of which LAPACK needs one function and its way to print.
#include <stddef.h>
#include <string.h>
#include <tiffio.h>

/// libtiff asks each packing to set up its decoder. One that sets up none leaves libtiff's own,
/// which refuses to decode; the file opens, and clast names the packing that it does not read
/// (src/io/volume_tiff.c), as it does with the whole of libtiff.
#define LEAVE_OUT(packing)                                                                         \
    int TIFFInit##packing(TIFF *file, int scheme);                                                 \
    int TIFFInit##packing(TIFF *file, int scheme)                                                  \
    {                                                                                              \
        (void)file;                                                                                \
        (void)scheme;                                                                              \
        return 1;                                                                                  \
    }

LEAVE_OUT(JBIG)
LEAVE_OUT(LERC)
LEAVE_OUT(JPEG)
LEAVE_OUT(OJPEG)
LEAVE_OUT(WebP)
LEAVE_OUT(ZSTD)
LEAVE_OUT(LZMA)

int TIFFJPEGIsFullStripRequired(TIFF *file);
int TIFFJPEGIsFullStripRequired(TIFF *file)
{
    (void)file;
    return 0;
}

/// LAPACK's way to tell a wrong argument, meant to be replaced: its own prints and ends the
/// process. Routines return INFO all the same.
void xerbla_(const char *routine, const int *info, size_t n_routine);
void xerbla_(const char *routine, const int *info, size_t n_routine)
{
    (void)routine;
    (void)info;
    (void)n_routine;
}

// NOLINTBEGIN(bugprone-reserved-identifier,cert-dcl37-c,cert-dcl51-cpp)
/// Fortran's a // b into `to`: cut at its end, or filled up with blanks.
void _gfortran_concat_string(size_t n, char *to, size_t n_a, const char *a, size_t n_b,
                             const char *b);
void _gfortran_concat_string(size_t n, char *to, size_t n_a, const char *a, size_t n_b,
                             const char *b)
{
    const size_t first = n_a < n ? n_a : n;
    const size_t second = n_b < n - first ? n_b : n - first;
    memcpy(to, a, first);
    memcpy(to + first, b, second);
    memset(to + first + second, ' ', n - first - second);
}
// NOLINTEND(bugprone-reserved-identifier,cert-dcl37-c,cert-dcl51-cpp)
