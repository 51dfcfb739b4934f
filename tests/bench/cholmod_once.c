/* CHOLMOD on the equations that write_matrix wrote: analyse, factorise, solve, once each, on one thread.
 *
 *    cholmod_once FILE METIS|own
 *
 * Supernodal LL', ordered by METIS, or by whatever CHOLMOD's own strategy takes: it tries AMD first. Where that is METIS again,
 * `ordering METIS` is all that it prints, and nothing is factorised. Prints one figure a line: the ordering, unknowns, entries of
 * the factor, operations (multiplications and additions), seconds, user and system seconds of all three, memory, the residual
 * |b - A x|/|b|, the largest deflection of an interface element, and the library that its BLAS came from.
 */
#define _GNU_SOURCE
#include <suitesparse/cholmod.h>
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <time.h>

void openblas_set_num_threads(int n);

static double seconds(void)
{
   struct timespec now;
   clock_gettime(CLOCK_MONOTONIC, &now);
   return now.tv_sec + 1e-9*now.tv_nsec;
}

static double in_seconds(struct timeval t)
{
   return t.tv_sec + 1e-6*t.tv_usec;
}

static void fail(const char *what)
{
   fprintf(stderr, "cholmod_once: %s\n", what);
   exit(1);
}

static void take(void *room, size_t size, size_t n, FILE *file)
{
   if (fread(room, size, n, file) != n) fail("the file ends too early");
}

static const char *ordering_name(int ordering)
{
   switch (ordering) {
   case CHOLMOD_NATURAL: return "natural";
   case CHOLMOD_AMD:     return "AMD";
   case CHOLMOD_METIS:   return "METIS";
   case CHOLMOD_NESDIS:  return "NESDIS";
   default:              return "other";
   }
}

int main(int argc, char **argv)
{
   if (argc != 3) fail("usage: cholmod_once FILE METIS|own");
   const int own_choice = strcmp(argv[2], "own") == 0;
   if (!own_choice && strcmp(argv[2], "METIS") != 0) fail("the ordering is neither METIS nor own");
   FILE *file = fopen(argv[1], "rb");
   if (!file) fail("no such file");
   cholmod_common c;
   cholmod_start(&c);
   openblas_set_num_threads(1);

   int head[3];
   take(head, sizeof(int), 3, file);
   const int n = head[0], entries = head[1], joints = head[2];
   cholmod_sparse *a = cholmod_allocate_sparse(n, n, entries, 0, 1, -1, CHOLMOD_REAL, &c);
   cholmod_dense *b = cholmod_allocate_dense(n, 1, n, CHOLMOD_REAL, &c);
   int *row = malloc(6*sizeof(int)*joints);
   double *closing = malloc(6*sizeof(double)*joints);
   if (!a || !b || !row || !closing) fail("no memory for the equations");
   take(a->p, sizeof(int), n + 1, file);
   take(a->i, sizeof(int), entries, file);
   take(a->x, sizeof(double), entries, file);
   take(b->x, sizeof(double), n, file);
   take(row, sizeof(int), 6*(size_t)joints, file);
   take(closing, sizeof(double), 6*(size_t)joints, file);
   fclose(file);
   if (!cholmod_check_sparse(a, &c)) fail("the file holds no matrix");

   c.supernodal = CHOLMOD_SUPERNODAL;
   c.final_ll = 1;
   if (!own_choice) {
      c.nmethods = 1;
      c.method[0].ordering = CHOLMOD_METIS;
   }
   struct rusage before, after;
   getrusage(RUSAGE_SELF, &before);
   const double t0 = seconds();
   cholmod_factor *l = cholmod_analyze(a, &c);
   const double t1 = seconds();
   if (!l) fail("the analysis failed");
   if (own_choice && l->ordering == CHOLMOD_METIS) {
      printf("ordering METIS\n");
      return 0;
   }
   cholmod_factorize(a, l, &c);
   const double t2 = seconds();
   if (c.status != CHOLMOD_OK) fail("the factorisation failed");
   cholmod_dense *x = cholmod_solve(CHOLMOD_A, l, b, &c);
   const double t3 = seconds();
   getrusage(RUSAGE_SELF, &after);
   if (!x) fail("the solution failed");

   double one[2] = {1, 0}, minus_one[2] = {-1, 0};
   const double load = cholmod_norm_dense(b, 2, &c);
   cholmod_sdmult(a, 0, minus_one, one, x, b, &c);
   double largest = 0;
   const double *u = x->x;
   for (int i = 0; i < joints; i++) {
      double lambda = 0;
      for (int k = 0; k < 6; k++)
         if (row[6*i + k] >= 0) lambda += closing[6*i + k]*u[row[6*i + k]];
      if (lambda > largest) largest = lambda;
   }
   Dl_info blas;
   if (!dladdr(dlsym(RTLD_DEFAULT, "dgemm_"), &blas)) fail("its BLAS cannot be found");

   printf("ordering %s\n", ordering_name(l->ordering));
   printf("unknowns %d\n", n);
   printf("entries %.0f\n", c.lnz);
   printf("operations %.6e\n", c.fl);
   printf("analyse %.6f\n", t1 - t0);
   printf("factor %.6f\n", t2 - t1);
   printf("solve %.6f\n", t3 - t2);
   printf("user %.6f\n", in_seconds(after.ru_utime) - in_seconds(before.ru_utime));
   printf("system %.6f\n", in_seconds(after.ru_stime) - in_seconds(before.ru_stime));
   printf("memory %.0f\n", c.memory_usage/1048576.0);
   printf("residual %.1e\n", cholmod_norm_dense(b, 2, &c)/load);
   printf("deflection %.5E\n", largest);
   printf("blas %s\n", blas.dli_fname);
   return 0;
}
