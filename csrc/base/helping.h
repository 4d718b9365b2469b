/* Decides whether helpers speed a job up, or hold it up.
 *
 * In:  for each job the CPU time of its threads, and the time that passed.
 * Out: whether the next job is better done alone.
 * If other programs use the CPUs, a thread that loses its CPU within a tile holds up the whole job, so that two threads may
 * get less done than one. So each way of working is measured by its CPU time over the time that passed, whatever the jobs are.
 */
#pragma once

#include <stdint.h>

/* The times of jobs, in nanoseconds. */
typedef struct e3d_job_times {
    int64_t own, all;        /* CPU time: the caller's, and that of all threads */
    int64_t working, passed; /* the caller's wall clock: without waiting for helpers, and with it */
} e3d_job_times;

typedef struct e3d_helping {
    int alone;             /* not 0: jobs are now done without helpers */
    double rate[2];        /* the CPU time a unit of time that each way got lately; 0: not measured yet */
    double share;          /* the caller's share of its own CPU while it does not wait */
    e3d_job_times times;   /* since the last measurement */
    int64_t try_at, pause; /* when the other way is tried again, and the pause until then */
} e3d_helping;

/* Working alone is not tried while helpers get much done, or clearly more than the caller would do meanwhile. It is chosen
 * only if it is clearly better. */
#define E3D_MUCH 0.7
#define E3D_PLAINLY_MORE 1.2
#define E3D_PLAINLY_BETTER 1.1

static inline int e3d_helping_pays(const e3d_helping *h)
{
    return h->rate[0] >= E3D_MUCH || h->rate[0] >= E3D_PLAINLY_MORE * h->share;
}

/* Chooses the next way after this one was measured. The longer a way stays, the more rarely the other one is tried. */
static inline void e3d_helping_choose(e3d_helping *h, int64_t now)
{
    enum { SHORTEST_NS = 200000000 };
    const int64_t longest_ns = 3200000000;
    if (!h->alone && e3d_helping_pays(h)) {
        h->pause = 0;
    } else if (now >= h->try_at) {
        h->pause = h->pause ? 2 * h->pause : SHORTEST_NS;
        h->pause = h->pause < longest_ns ? h->pause : longest_ns;
        h->try_at = now + h->pause;
        h->alone = !h->alone;
    } else {
        h->alone = h->rate[1] > E3D_PLAINLY_BETTER * h->rate[0];
    }
}

/* Records a job that is over. */
static inline void e3d_helping_note(e3d_helping *h, const e3d_job_times *job, int64_t now)
{
    enum { HELPED_NS = 50000000,
           ALONE_NS = 150000000 }; /* a scheduler takes its time to move other threads */
    e3d_job_times *sum = &h->times;
    sum->own += job->own;
    sum->all += job->all;
    sum->working += job->working;
    sum->passed += job->passed;
    if (sum->passed < (h->alone ? ALONE_NS : HELPED_NS))
        return;
    double rate = (double)sum->all / (double)sum->passed, *mean = &h->rate[h->alone];
    double share = (double)sum->own / (double)sum->working;
    int better = !h->alone && rate >= E3D_MUCH && *mean < E3D_MUCH;
    *mean = *mean == 0 || better ? rate : *mean + (rate - *mean) / 4;
    if (!h->alone)
        h->share = h->share == 0 || better ? share : h->share + (share - h->share) / 4;
    *sum = (e3d_job_times){0};
    e3d_helping_choose(h, now);
}
