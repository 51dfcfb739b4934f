/* OpenMP as gfortran calls it, on POSIX threads and in view of the thread sanitizer: libgomp is not instrumented, and the sanitizer
   takes whatever is ordered by it alone for a race. Here it is told, and nothing more than OpenMP promises: what a task is given
   comes before it, what it has done before the end of the taskwait of its parent and of the barrier, and all that is before a
   parallel region ends. The queue of tasks itself orders nothing. Only what the program uses; a call that is not here is one of
   libgomp, and its name a hint to add it. Not instrumented itself. OMP_NUM_THREADS threads, 4; TASKS_SEED varies which task is next. */
#define _GNU_SOURCE
#include <pthread.h>
#include <sched.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

extern void __tsan_acquire(void *);
extern void __tsan_release(void *);

typedef struct task {
   void (*routine)(void *);
   void *data;
   struct task *parent, *next;
   struct task *last, *before; /* the last child with dependences; the sibling with dependences before */
   void **depends;             /* places: all, those written, then the places, the written ones first; NULL: none */
   bool done;
   int children; /* not done yet; its address is what their ends and the taskwait meet at */
} task;

typedef struct {
   void (*routine)(void *);
   void *data;
   int threads, arrived, round, singles, left; /* left: tasks that are not done */
   long next_index, end, step, chunk;
   int loops;
} team_type;

typedef struct { team_type *team; int number; } member;

static int n_threads = 0;
static team_type *team; /* one at a time: the program does not nest them */
static task *queue;
static int lock_word, critical_word;
static unsigned seed;
static __thread task *now;
static __thread int singles_met, loops_met, my_number;

static void lock(void) { while (__atomic_exchange_n(&lock_word, 1, __ATOMIC_ACQUIRE)) sched_yield(); }
static void unlock(void) { __atomic_store_n(&lock_word, 0, __ATOMIC_RELEASE); }

int omp_get_num_procs_(void) { return 64; }
void omp_set_num_threads_(const int *n) { n_threads = *n; }
int omp_get_max_threads_(void)
{
   const char *words = getenv("OMP_NUM_THREADS");
   if (n_threads == 0) n_threads = words ? atoi(words) : 4;
   return n_threads;
}
int omp_get_num_threads(void) { return team ? team->threads : 1; }
int omp_get_num_threads_(void) { return omp_get_num_threads(); }
int omp_in_parallel_(void) { return team && team->threads > 1; }
int omp_get_thread_num(void) { return team ? my_number : 0; }
double omp_get_wtime_(void)
{
   struct timespec t;
   clock_gettime(CLOCK_MONOTONIC, &t);
   return t.tv_sec + 1e-9*t.tv_nsec;
}

/* Whether T must follow its sibling S: a place of both that one of them writes. */
static bool must_follow(const task *t, const task *s)
{
   long i, j, n = (long)t->depends[0], m = (long)s->depends[0];
   for (i = 0; i < n; i++)
      for (j = 0; j < m; j++)
         if (t->depends[2 + i] == s->depends[2 + j] && (i < (long)t->depends[1] || j < (long)s->depends[1])) return true;
   return false;
}

static bool may_run(const task *t)
{
   const task *s;
   for (s = t->before; s; s = s->before)
      if (!s->done && must_follow(t, s)) return false;
   return true;
}

/* Any task of the queue that may run; NULL: there is none. */
static task *take(void)
{
   task **at, **found = NULL, *taken = NULL;
   int skip;
   lock();
   seed = seed*1103515245u + 12345u;
   skip = (seed >> 16) % 3;
   for (at = &queue; *at && skip >= 0; at = &(*at)->next)
      if (may_run(*at)) { found = at; skip--; }
   if (found) {
      taken = *found;
      *found = taken->next;
   }
   unlock();
   return taken;
}

static void run(task *t)
{
   task *before = now, *s;
   now = t;
   __tsan_acquire(t);
   for (s = t->before; s; s = s->before)
      if (must_follow(t, s)) __tsan_acquire(s);
   t->routine(t->data);
   __tsan_release(t);
   lock();
   t->done = true;
   unlock();
   __tsan_release(&t->parent->children);
   __tsan_release(team);
   now = before;
   __atomic_sub_fetch(&t->parent->children, 1, __ATOMIC_ACQ_REL);
   __atomic_sub_fetch(&team->left, 1, __ATOMIC_ACQ_REL);
   /* a task is not freed: its address is what others have met at */
}

void GOMP_task(void (*routine)(void *), void *data, void (*copy)(void *, void *), long size, long align, bool deferred,
               unsigned flags, void **depend, int priority)
{
   task *t = calloc(1, sizeof *t);
   char *room = malloc(size + align);
   (void)priority;
   t->data = (void *)(((unsigned long)room + align - 1) / align * align);
   if (copy) copy(t->data, data);
   else memcpy(t->data, data, size);
   t->routine = routine;
   t->parent = now;
   if (!deferred || !team || team->threads == 1) {
      task *before = now;
      now = t;
      routine(t->data);
      now = before;
      return;
   }
   __atomic_add_fetch(&now->children, 1, __ATOMIC_ACQ_REL);
   __atomic_add_fetch(&team->left, 1, __ATOMIC_ACQ_REL);
   __tsan_release(t);
   lock();
   if (flags & 8) { /* the way of GCC where tasks depend by in, out and inout alone */
      size_t bytes = sizeof(void *)*(2 + (size_t)depend[0]);
      t->depends = malloc(bytes);
      memcpy(t->depends, depend, bytes);
      t->before = now->last;
      now->last = t;
   }
   t->next = queue;
   queue = t;
   unlock();
}

void GOMP_taskwait(void)
{
   task *t;
   while (__atomic_load_n(&now->children, __ATOMIC_ACQUIRE) > 0) {
      t = take();
      if (t) run(t);
      else sched_yield();
   }
   __tsan_acquire(&now->children);
}

/* critical: the sections of all names share one lock */
void GOMP_critical_name_start(void **name)
{
   while (__atomic_exchange_n(&critical_word, 1, __ATOMIC_ACQUIRE)) sched_yield();
   __tsan_acquire(&critical_word);
   (void)name;
}

void GOMP_critical_name_end(void **name)
{
   __tsan_release(&critical_word);
   __atomic_store_n(&critical_word, 0, __ATOMIC_RELEASE);
   (void)name;
}

void GOMP_barrier(void)
{
   task *t;
   int round = __atomic_load_n(&team->round, __ATOMIC_ACQUIRE);
   __tsan_release(team);
   __atomic_add_fetch(&team->arrived, 1, __ATOMIC_ACQ_REL);
   for (;;) {
      if (__atomic_load_n(&team->round, __ATOMIC_ACQUIRE) != round) break;
      t = take();
      if (t) { run(t); continue; }
      lock();
      if (team->round == round && team->arrived == team->threads && __atomic_load_n(&team->left, __ATOMIC_ACQUIRE) == 0) {
         team->arrived = 0;
         team->round++;
      }
      unlock();
      sched_yield();
   }
   __tsan_acquire(team);
}

bool GOMP_single_start(void)
{
   bool first;
   lock();
   first = team->singles == singles_met++;
   if (first) team->singles++;
   unlock();
   return first;
}

bool GOMP_loop_nonmonotonic_dynamic_next(long *start, long *end)
{
   lock();
   *start = team->next_index;
   *end = *start + team->chunk*team->step;
   if (*end > team->end) *end = team->end;
   team->next_index = *end;
   unlock();
   return *start < *end;
}

bool GOMP_loop_nonmonotonic_dynamic_start(long start, long end, long step, long chunk, long *from, long *to)
{
   lock();
   if (team->loops == loops_met++) {
      team->loops++;
      team->next_index = start, team->end = end, team->step = step, team->chunk = chunk;
   }
   unlock();
   return GOMP_loop_nonmonotonic_dynamic_next(from, to);
}

bool GOMP_loop_dynamic_next(long *start, long *end) { return GOMP_loop_nonmonotonic_dynamic_next(start, end); }
bool GOMP_loop_dynamic_start(long start, long end, long step, long chunk, long *from, long *to)
{
   return GOMP_loop_nonmonotonic_dynamic_start(start, end, step, chunk, from, to);
}
void GOMP_loop_end(void) { GOMP_barrier(); }
void GOMP_loop_end_nowait(void) {}

static void *work(void *argument)
{
   member *me = argument;
   task top = {0};
   now = &top;
   singles_met = loops_met = 0;
   my_number = me->number;
   me->team->routine(me->team->data);
   GOMP_barrier();
   return NULL;
}

/* MINE: what its routine is, and its loop where it begins with one */
static void parallel(team_type mine, unsigned threads)
{
   team_type *before = team;
   task *task_before = now;
   pthread_t handles[64];
   member members[64];
   int i;
   if (!seed) seed = getenv("TASKS_SEED") ? atoi(getenv("TASKS_SEED")) : 1;
   mine.threads = threads ? threads : (unsigned)omp_get_max_threads_();
   if (mine.threads > 64) mine.threads = 64;
   team = &mine;
   for (i = 0; i < mine.threads; i++) members[i] = (member){&mine, i};
   for (i = 1; i < mine.threads; i++) pthread_create(&handles[i], NULL, work, &members[i]);
   work(&members[0]);
   for (i = 1; i < mine.threads; i++) pthread_join(handles[i], NULL);
   team = before;
   now = task_before;
}

void GOMP_parallel(void (*routine)(void *), void *data, unsigned threads, unsigned flags)
{
   (void)flags;
   parallel((team_type){.routine = routine, .data = data}, threads);
}

void GOMP_parallel_loop_nonmonotonic_dynamic(void (*routine)(void *), void *data, unsigned threads, long start, long end, long step,
                                             long chunk, unsigned flags)
{
   (void)flags;
   parallel((team_type){.routine = routine, .data = data, .next_index = start, .end = end, .step = step, .chunk = chunk}, threads);
}

void GOMP_parallel_loop_dynamic(void (*routine)(void *), void *data, unsigned threads, long start, long end, long step, long chunk,
                                unsigned flags)
{
   GOMP_parallel_loop_nonmonotonic_dynamic(routine, data, threads, start, end, step, chunk, flags);
}

/* Sections are a loop over their numbers, from 1 on; 0: no more. */
unsigned GOMP_sections_next(void)
{
   long number, behind;
   return GOMP_loop_nonmonotonic_dynamic_next(&number, &behind) ? (unsigned)number : 0;
}
void GOMP_sections_end_nowait(void) {}

void GOMP_parallel_sections(void (*routine)(void *), void *data, unsigned threads, unsigned count, unsigned flags)
{
   (void)flags;
   parallel((team_type){.routine = routine, .data = data, .next_index = 1, .end = (long)count + 1, .step = 1, .chunk = 1}, threads);
}
