/* For memory.sh: memory that ends at a given allocation. LD_PRELOADed, it counts the requests of at least FAIL_BYTES (4097: more than
   a buffer of C's stdio, of which gcov takes one for every file that it writes when the program has ended), and from the FAIL_FROM-th
   on (never) they all fail. FAIL_COUNT names a file that the count is written to at the end. */
#define _GNU_SOURCE
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>

extern void *__libc_malloc(size_t), *__libc_calloc(size_t, size_t), *__libc_realloc(void *, size_t);

static long n, from = -1, bytes;

static int fails(size_t size)
{
   long this;
   if (__atomic_load_n(&from, __ATOMIC_RELAXED) < 0) {
      const char *text = getenv("FAIL_BYTES");
      bytes = text ? atol(text) : 4097;
      text = getenv("FAIL_FROM");
      __atomic_store_n(&from, text ? atol(text) : 0, __ATOMIC_RELAXED);
   }
   if ((long)size < bytes && size < (size_t)1 << 40) return 0;
   this = __atomic_add_fetch(&n, 1, __ATOMIC_RELAXED);
   if (from == 0 || this < from) return 0;
   errno = ENOMEM;
   return 1;
}

void *malloc(size_t size) { return fails(size) ? NULL : __libc_malloc(size); }
void *calloc(size_t m, size_t size) { return fails(m*size) ? NULL : __libc_calloc(m, size); }
void *realloc(void *p, size_t size) { return fails(size) ? NULL : __libc_realloc(p, size); }

static void __attribute__((destructor)) count(void)
{
   const char *path = getenv("FAIL_COUNT");
   FILE *file = path ? fopen(path, "w") : NULL;
   if (!file) return;
   fprintf(file, "%ld\n", n);
   fclose(file);
}
