/* The process's one thread pool: made at the first frame, remade after a fork.
 *
 * Helpers sleep on a condition variable between jobs. A frame is several jobs, so before they sleep they watch for the next one
 * (they spin) for about as long as waking up takes: a small picture takes 4 % less time. A helper that has not come when the
 * caller runs out of work is not waited for. A second caller does not wait for the pool: it works alone, which cannot deadlock
 * and gives the same picture. So does the owner as long as helpers are waited for more than they help (helping.h).
 */
#include "base/pool.h"

#include <pthread.h>
#include <stdatomic.h>

#include "base/clock.h"
#include "base/fpenv.h"
#include "base/helping.h"
#include "base/limits.h"
#include "base/machine.h"
#include "base/system.h"
#include "e3d.h"

static struct {
    pthread_mutex_t owner; /* held by the caller whose job runs */
    pthread_mutex_t lock;  /* guards the members that follow */
    pthread_cond_t start, done;
    int threads;           /* how many threads exist, without the caller */
    int wanted, running;   /* how many helpers may still join the job (none once it is over); how many are at work */
    int64_t used;          /* the CPU time of helpers that have returned */
    int64_t joined;        /* when the first helper joined the job; 0: none has */
    int64_t left[2];       /* when the last thread left the job, and the one before it */
    unsigned long job;
    void (*work)(void *, int);
    void *argument;
    e3d_helping helping;   /* the owner's */
    atomic_int watches;    /* whether threads spin, since there is a CPU for each */
    /* The last job; it is set after the lock is released, so that a thread that spins on it finds the lock free */
    atomic_ulong posted;
    atomic_ulong finished; /* the last job whose last helper returned after it was over; the caller spins on it */
} pool = {.owner = PTHREAD_MUTEX_INITIALIZER,
          .lock = PTHREAD_MUTEX_INITIALIZER,
          .start = PTHREAD_COND_INITIALIZER,
          .done = PTHREAD_COND_INITIALIZER};

static pthread_once_t fork_guard = PTHREAD_ONCE_INIT;
static _Thread_local int owning;          /* the pool */
static _Thread_local int64_t together_ns; /* of the jobs that the thread has run */

#if defined(_WIN32) || defined(__wasi__) /* where no process forks */

static void guard_fork(void) {}

#else

/* A fork does not wait for a running job, which may itself wait for the forking thread, or be that thread's own. */
static void before_fork(void) { pthread_mutex_lock(&pool.lock); }

static void in_parent(void) { pthread_mutex_unlock(&pool.lock); }

static void in_child(void) /* only the forking thread exists in the child */
{
    if (!owning)
        pthread_mutex_init(&pool.owner, NULL);
    pthread_mutex_init(&pool.lock, NULL);
    pthread_cond_init(&pool.start, NULL);
    pthread_cond_init(&pool.done, NULL);
    pool.threads = pool.wanted = pool.running = 0;
}

static void guard_fork(void) { pthread_atfork(before_fork, in_parent, in_child); }

#endif

/* The lock is held. */
static void note_leaving(int64_t now)
{
    if (now > pool.left[0]) {
        pool.left[1] = pool.left[0];
        pool.left[0] = now;
    } else if (now > pool.left[1]) {
        pool.left[1] = now;
    }
}

enum { WAKING_NS = 30000 }; /* about the time that a thread takes to wake up */

/* Spins until the number reaches a job's, at most as long as waking up takes. */
static void watch(const atomic_ulong *number, unsigned long job)
{
    if (!atomic_load(&pool.watches))
        return;
    for (int64_t end = e3d_now_ns() + WAKING_NS; atomic_load(number) < job && e3d_now_ns() < end;)
        e3d_pause();
}

/* Waits for a job to join that is newer than `seen`; returns its number, with the lock held. */
static unsigned long await_job(int worker, unsigned long seen)
{
    for (;;) {
        watch(&pool.posted, seen + 1);
        pthread_mutex_lock(&pool.lock);
        while (pool.job == seen)
            pthread_cond_wait(&pool.start, &pool.lock);
        if (worker <= pool.wanted)
            return pool.job;
        seen = pool.job; /* it needs no more helpers */
        pthread_mutex_unlock(&pool.lock);
    }
}

static void *helper(void *number)
{
    int worker = (int)(intptr_t)number;
    pthread_mutex_lock(&pool.lock);
    unsigned long seen = pool.job - 1; /* the job that is about to start is new to it */
    pthread_mutex_unlock(&pool.lock);
    for (;;) {
        seen = await_job(worker, seen);
        pool.running++;
        pool.joined = pool.joined ? pool.joined : e3d_now_ns();
        void (*work)(void *, int) = pool.work;
        void *argument = pool.argument;
        pthread_mutex_unlock(&pool.lock);
        int64_t began = e3d_thread_ns();
        e3d_fpenv saved = e3d_fpenv_enter();
        work(argument, worker);
        e3d_fpenv_leave(saved);
        int64_t used = e3d_thread_ns() - began;
        pthread_mutex_lock(&pool.lock);
        pool.used += used;
        note_leaving(e3d_now_ns());
        int last = --pool.running == 0 && !pool.wanted;
        if (last)
            pthread_cond_signal(&pool.done);
        pthread_mutex_unlock(&pool.lock);
        if (last)
            atomic_store(&pool.finished, seen);
    }
    return NULL;
}

static void start_helpers(int wanted)
{
    while (pool.threads < wanted) {
        pthread_t thread;
        if (pthread_create(&thread, NULL, helper, (void *)(intptr_t)(pool.threads + 1)))
            break;
        pthread_detach(thread);
        pool.threads++;
    }
}

static void make_helpers(int wanted)
{
    if (pool.threads >= wanted)
        return;
    atomic_store(&pool.watches, wanted < e3d_thread_count());
    e3d_without_signals(start_helpers, wanted);
}

/* Ends the job, and waits for the helpers that are at work; returns the CPU time of all helpers. */
static int64_t await_helpers(void)
{
    pthread_mutex_lock(&pool.lock);
    pool.wanted = 0;
    note_leaving(e3d_now_ns());
    if (pool.running) {
        unsigned long job = pool.job;
        pthread_mutex_unlock(&pool.lock);
        watch(&pool.finished, job);
        pthread_mutex_lock(&pool.lock);
    }
    while (pool.running)
        pthread_cond_wait(&pool.done, &pool.lock);
    int64_t used = pool.used;
    if (pool.joined && pool.left[1] > pool.joined)
        together_ns += pool.left[1] - pool.joined;
    pthread_mutex_unlock(&pool.lock);
    return used;
}

static void post_job(int helpers, void (*work)(void *, int), void *argument)
{
    pthread_mutex_lock(&pool.lock);
    pool.job++;
    make_helpers(helpers);
    pool.wanted = helpers < pool.threads ? helpers : pool.threads;
    pool.work = work;
    pool.argument = argument;
    pool.used = pool.joined = pool.left[0] = pool.left[1] = 0;
    pthread_cond_broadcast(&pool.start);
    pthread_mutex_unlock(&pool.lock);
    atomic_store(&pool.posted, pool.job);
}

/* Runs a job as the pool's owner. */
static void run_job(int helpers, void (*work)(void *, int), void *argument)
{
    int64_t began = e3d_now_ns(), used = e3d_thread_ns();
    if (helpers)
        post_job(helpers, work, argument);
    work(argument, 0);
    e3d_job_times times = {.own = e3d_thread_ns() - used, .working = e3d_now_ns() - began};
    times.all = times.own + (helpers ? await_helpers() : 0);
    int64_t now = e3d_now_ns();
    times.passed = now - began;
    e3d_helping_note(&pool.helping, &times, now);
}

void e3d_pool_run(int threads, void (*work)(void *, int), void *argument)
{
    pthread_once(&fork_guard, guard_fork);
    if (threads > E3D_MAX_THREADS)
        threads = E3D_MAX_THREADS;
    if (threads <= 1 || pthread_mutex_trylock(&pool.owner)) {
        work(argument, 0);
        return;
    }
    owning = 1;
    run_job(pool.helping.alone ? 0 : threads - 1, work, argument);
    owning = 0;
    pthread_mutex_unlock(&pool.owner);
}

typedef struct shared {
    atomic_int next;
    int tasks;
    void (*task)(void *, int);
    void *argument;
} shared;

static void take_tasks(void *argument, int worker)
{
    shared *s = argument;
    (void)worker;
    for (int i; (i = atomic_fetch_add(&s->next, 1)) < s->tasks;)
        s->task(s->argument, i);
}

void e3d_pool_share(int threads, int tasks, void (*task)(void *, int), void *argument)
{
    shared s = {.tasks = tasks, .task = task, .argument = argument};
    e3d_pool_run(threads < tasks ? threads : tasks, take_tasks, &s);
}

int64_t e3d_pool_together_ns(void) { return together_ns; }
