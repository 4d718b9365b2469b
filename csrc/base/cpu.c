/* The capabilities of this machine: instruction sets of CPU and operating system, and usable CPUs.
 * The number of threads is that of the affinity mask, capped by the cgroup's CPU quota (v2 cpu.max, v1 cfs_quota_us), since
 * the mask doesn't show a container's quota. */
#include <stdio.h>

#include "base/limits.h"
#include "base/machine.h"
#include "base/system.h"
#include "e3d.h"

int e3d_backend_available(e3d_backend backend)
{
    switch (backend) {
    case E3D_BACKEND_SCALAR:
    case E3D_BACKEND_PORTABLE: return 1;
#define HAS(instructions) e3d_has_instructions(instructions)
#define AVAILABLE(backend, name, has_all) \
    case backend: return (has_all) != 0;
        E3D_EACH_BUILT_BACKEND(AVAILABLE)
    default: return 0;
    }
}

e3d_backend e3d_backend_best(void)
{
    for (int b = E3D_BACKEND_COUNT - 1; b > E3D_BACKEND_PORTABLE; b--)
        if (e3d_backend_available((e3d_backend)b))
            return (e3d_backend)b;
    return E3D_BACKEND_PORTABLE;
}

/* How many CPUs the quota allows, rounded up; 0 if there is none. */
static int quota_count(void)
{
    long long quota = 0, period = 0;
    FILE *file = fopen("/sys/fs/cgroup/cpu.max", "r");
    if (file) {
        if (fscanf(file, "%lld %lld", &quota, &period) != 2)
            quota = 0; /* "max" */
        fclose(file);
    } else {
        file = fopen("/sys/fs/cgroup/cpu/cpu.cfs_quota_us", "r");
        if (file) {
            if (fscanf(file, "%lld", &quota) != 1)
                quota = 0;
            fclose(file);
        }
        file = fopen("/sys/fs/cgroup/cpu/cpu.cfs_period_us", "r");
        if (file) {
            if (fscanf(file, "%lld", &period) != 1)
                period = 0;
            fclose(file);
        }
    }
    if (quota <= 0 || period <= 0)
        return 0;
    long long cpus = (quota + period - 1) / period;
    return cpus < E3D_MAX_THREADS ? (int)cpus : E3D_MAX_THREADS;
}

int e3d_thread_count(void)
{
    int count = e3d_usable_processors(), quota = quota_count();
    if (quota && quota < count)
        count = quota;
    if (count > E3D_MAX_THREADS)
        count = E3D_MAX_THREADS;
    return count > 0 ? count : 1;
}
