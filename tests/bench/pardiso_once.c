/* PARDISO of MKL on the equations that write_matrix wrote: analyse, factorise, solve, once each.
 *
 *    pardiso_once FILE THREADS
 *
 * Prints one figure a line: seconds of the solution and of its three parts, unknowns, the residual |b - A x|/|b|. `make bench` builds
 * it where MKLROOT names MKL.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

/* of mkl_pardiso.h, mkl_service.h: integers of 32 bits */
void pardisoinit(void *handle, const int *type, int *options);
void pardiso(void *handle, const int *matrices, const int *which, const int *type, const int *phase, const int *n, const double *a,
             const int *first, const int *column, int *order, const int *sides, int *options, const int *says, double *b, double *x,
             int *error);
void MKL_Set_Num_Threads(int n);

static double seconds(void)
{
   struct timespec now;
   clock_gettime(CLOCK_MONOTONIC, &now);
   return now.tv_sec + 1e-9*now.tv_nsec;
}

static void fail(const char *what)
{
   fprintf(stderr, "pardiso_once: %s\n", what);
   exit(1);
}

static void *take(size_t size, size_t n, FILE *file)
{
   void *room = malloc(size*n);
   if (!room || fread(room, size, n, file) != n) fail("no memory, or the file ends too early");
   return room;
}

struct entry { int column; double value; };

static int by_column(const void *a, const void *b)
{
   return ((const struct entry *)a)->column - ((const struct entry *)b)->column;
}

int main(int argc, char **argv)
{
   if (argc != 3) fail("usage: pardiso_once FILE THREADS");
   FILE *file = fopen(argv[1], "rb");
   if (!file) fail("no such file");
   int *head = take(sizeof(int), 3, file);
   const int n = head[0], entries = head[1];
   int *first = take(sizeof(int), n + 1, file), *column = take(sizeof(int), entries, file);
   double *a = take(sizeof(double), entries, file), *b = take(sizeof(double), n, file), *x = calloc(2*(size_t)n, sizeof(double));
   struct entry *row = malloc(sizeof(struct entry)*(entries + 1));
   if (!x || !row) fail("no memory");
   fclose(file);
   /* a column of the lower triangle is a row of the upper one: from 1 on, ascending */
   for (int i = 0; i < n; i++) {
      const int m = first[i + 1] - first[i];
      for (int k = 0; k < m; k++) row[k] = (struct entry){column[first[i] + k] + 1, a[first[i] + k]};
      qsort(row, m, sizeof(struct entry), by_column);
      for (int k = 0; k < m; k++) {
         column[first[i] + k] = row[k].column;
         a[first[i] + k] = row[k].value;
      }
   }
   for (int i = 0; i <= n; i++) first[i]++;

   void *handle[64] = {0};
   int options[64] = {0}, one = 1, error = 0;
   const int type = 2 /* symmetric, positive definite */, none = 0, phases[] = {11, 22, 33};
   double t[4];
   MKL_Set_Num_Threads(atoi(argv[2]));
   pardisoinit(handle, &type, options);
   options[1] = 3; /* nested dissection by several threads */
   t[0] = seconds();
   for (int k = 0; k < 3; k++) {
      pardiso(handle, &one, &one, &type, &phases[k], &n, a, first, column, NULL, &one, options, &none, b, x, &error);
      if (error != 0) fail("PARDISO failed");
      t[k + 1] = seconds();
   }

   double *r = x + n, load = 0, left = 0;
   for (int i = 0; i < n; i++)
      for (int k = first[i] - 1; k < first[i + 1] - 1; k++) {
         const int j = column[k] - 1;
         r[i] += a[k]*x[j];
         if (j != i) r[j] += a[k]*x[i];
      }
   for (int i = 0; i < n; i++) {
      load += b[i]*b[i];
      left += (b[i] - r[i])*(b[i] - r[i]);
   }
   printf("solution %.4f\nanalyse %.4f\nfactor %.4f\nsolve %.4f\nunknowns %d\nresidual %.1e\n", t[3] - t[0], t[1] - t[0], t[2] - t[1],
          t[3] - t[2], n, sqrt(left/load));
   return 0;
}
