/* For kernel.sh: another OpenBLAS and another processor. LD_PRELOADed, it gives CORENAME as the name of the kernel that OpenBLAS chooses by
   itself, and the file CPUINFO in place of /proc/cpuinfo. With the kernels named in WRONG dgemm gives wrong results; with those in CRASH
   it ends the process, with those in HANG it never returns. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <fcntl.h>
#include <signal.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

static const char *chosen(void)
{
   const char *kernel = getenv("OPENBLAS_CORETYPE");
   return kernel && *kernel ? kernel : getenv("CORENAME");
}

static int is_in(const char *list)
{
   const char *names = getenv(list);
   return names && strstr(names, chosen()) != NULL;
}

const char *openblas_get_corename(void) { return chosen(); }

void dgemm_(char *ta, char *tb, int *m, int *n, int *k, double *alpha, double *a, int *lda, double *b, int *ldb, double *beta, double *c,
            int *ldc, long la, long lb)
{
   void (*real)(char *, char *, int *, int *, int *, double *, double *, int *, double *, int *, double *, double *, int *, long, long);
   *(void **)&real = dlsym(RTLD_NEXT, "dgemm_");
   if (is_in("CRASH")) raise(SIGILL);
   while (is_in("HANG")) { }
   real(ta, tb, m, n, k, alpha, a, lda, b, ldb, beta, c, ldc, la, lb);
   if (is_in("WRONG") && *m > 64) c[*m - 1] += 1e-6;
}

static int open_other(const char *name, const char *path, int flags, va_list more)
{
   int (*real)(const char *, int, ...);
   *(void **)&real = dlsym(RTLD_NEXT, name);
   if (strcmp(path, "/proc/cpuinfo") == 0 && getenv("CPUINFO")) path = getenv("CPUINFO");
   return flags & O_CREAT ? real(path, flags, va_arg(more, int)) : real(path, flags);
}

int open(const char *path, int flags, ...)
{
   int descriptor;
   va_list more;
   va_start(more, flags);
   descriptor = open_other("open", path, flags, more);
   va_end(more);
   return descriptor;
}

int open64(const char *path, int flags, ...)
{
   int descriptor;
   va_list more;
   va_start(more, flags);
   descriptor = open_other("open64", path, flags, more);
   va_end(more);
   return descriptor;
}
