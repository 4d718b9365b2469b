/* Whether helpers get work done, or are waited for.
 *
 * In:  of each job, the time that its threads had of their CPUs, and the time that passed.
 * Out: whether the next one is better done alone.
 * Where other programs use the CPUs, a thread that loses its own amid a tile holds up the whole job, so that two may get less
 * done than one. It is measured: what a way of working gets of the CPUs in the time that passes, whatever the jobs are.
 */
#ifndef E3D_HELPING_H
#define E3D_HELPING_H

#include <stdint.h>

typedef struct e3d_helping {
    int alone;             /* how jobs are done now: without helpers; */
    double rate[2];        /* what each way gets of the CPUs, lately; 0: not measured yet */
    int64_t used, passed;  /* since the last measurement */
    int64_t try_at, pause; /* when the other way is tried again, and how long it was until then */
} e3d_helping;

/* Helpers are let go only for what is plainly better: a single thread never gets more than one CPU. */
#define E3D_GOOD_RATE 0.7
#define E3D_PLAINLY 1.1

/* After a job. The longer it stays the same, the seldomer the other way is tried. */
static inline void e3d_helping_note(e3d_helping *h, int64_t used, int64_t passed, int64_t now)
{
    enum { HELPED_NS = 50000000, ALONE_NS = 150000000, SHORTEST_NS = 200000000 }; /* a scheduler takes its time to move others */
    const int64_t longest_ns = 3200000000;
    h->used += used;
    h->passed += passed;
    if (h->passed < (h->alone ? ALONE_NS : HELPED_NS))
        return;
    double rate = (double)h->used / (double)h->passed, *mean = &h->rate[h->alone];
    int better = !h->alone && rate >= E3D_GOOD_RATE && *mean < E3D_GOOD_RATE;
    *mean = *mean == 0 || better ? rate : *mean + (rate - *mean) / 4;
    h->used = h->passed = 0;
    if (!h->alone && *mean >= E3D_GOOD_RATE) {
        h->pause = 0;
    } else if (now >= h->try_at) {
        h->pause = h->pause ? 2 * h->pause : SHORTEST_NS;
        h->pause = h->pause < longest_ns ? h->pause : longest_ns;
        h->try_at = now + h->pause;
        h->alone = !h->alone;
    } else {
        h->alone = h->rate[1] > E3D_PLAINLY * h->rate[0];
    }
}

#endif
