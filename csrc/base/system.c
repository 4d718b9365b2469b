/* Functions that Linux, macOS, Windows and WASI provide in different ways: system.h. */
#define _GNU_SOURCE
#include "base/system.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#if defined(_WIN32)
#define WIN32_LEAN_AND_MEAN
#include <windows.h>
#else
#include <unistd.h>
#endif
#if !defined(_WIN32) && !defined(__wasi__)
#define HAS_SIGNALS
#include <signal.h>
#endif
#if defined(__linux__)
#include <sched.h>
#include <sys/syscall.h>
#elif defined(__APPLE__)
#include <sys/random.h>
#endif

int e3d_random_bytes(void *bytes, size_t count)
{
#if defined(__linux__) /* called directly, since glibc has a function for it only from 2.25 on */
    const unsigned without_waiting = 1;
    return syscall(SYS_getrandom, bytes, count, without_waiting) == (long)count;
#elif defined(__APPLE__) || defined(__wasi__)
    return getentropy(bytes, count) == 0;
#elif defined(_WIN32)
    for (size_t at = 0; at < count; at += sizeof(unsigned)) {
        unsigned some;
        if (rand_s(&some))
            return 0;
        memcpy((char *)bytes + at, &some, count - at < sizeof some ? count - at : sizeof some);
    }
    return 1;
#else
    (void)bytes, (void)count;
    return 0;
#endif
}

#if defined(_WIN32)
/* Processors form groups of at most 64. A process runs on those of one group that its mask names; from Windows 11 on, on
 * several groups, unless it has been told otherwise. */
static long processors_of_groups(void)
{
    USHORT groups[64], count = 64;
    if (GetProcessGroupAffinity(GetCurrentProcess(), &count, groups) && count > 1) {
        long sum = 0;
        for (USHORT i = 0; i < count; i++)
            sum += (long)GetActiveProcessorCount(groups[i]);
        return sum;
    }
    DWORD_PTR own, whole;
    if (GetProcessAffinityMask(GetCurrentProcess(), &own, &whole) && own)
        return __builtin_popcountll(own);
    return (long)GetActiveProcessorCount(ALL_PROCESSOR_GROUPS);
}
#endif

int e3d_usable_processors(void)
{
#if defined(_WIN32)
    long online = processors_of_groups();
#else
#if defined(__linux__)
    cpu_set_t set;
    if (sched_getaffinity(0, sizeof set, &set) == 0)
        return CPU_COUNT(&set);
#endif
    long online = sysconf(_SC_NPROCESSORS_ONLN);
#endif
    return online > 0 ? (int)online : 1;
}

void e3d_without_signals(void (*start)(int), int argument)
{
#if defined(HAS_SIGNALS)
    sigset_t all, saved;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &saved);
    start(argument);
    pthread_sigmask(SIG_SETMASK, &saved, NULL);
#else
    start(argument);
#endif
}
