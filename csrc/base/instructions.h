/* The instruction sets that an x86 processor has, and whose registers the operating system saves. Compilers' own
 * __builtin_cpu_supports returns 0 if their runtime does not set it up, as zig's doesn't. Source: Intel 64 and IA-32
 * Architectures Software Developer's Manual, volume 2, CPUID, and volume 1, 13.3 and 15.2. */
#pragma once

#include <cpuid.h>
#include <stdatomic.h>
#include <stdint.h>
#include <string.h>

/* The bits that XCR0 must have: registers of SSE and AVX; these, the masks, and both parts of AVX-512's. */
enum { STATE_NONE = 0,
       STATE_AVX = 0x06,
       STATE_AVX512 = 0xE6 };

/* An instruction set: a bit of ECX of leaf 1, or of EBX of leaf 7. */
typedef struct e3d_instructions {
    const char *name; /* the name that compilers have for it */
    int leaf, bit;
    uint32_t state;
} e3d_instructions;

static const e3d_instructions E3D_INSTRUCTIONS[] = {
    {"sse4.1", 1, 19, STATE_NONE},
    {"avx2", 7, 5, STATE_AVX},
    {"avx512f", 7, 16, STATE_AVX512},
    {"avx512dq", 7, 17, STATE_AVX512},
    {"avx512cd", 7, 28, STATE_AVX512},
    {"avx512bw", 7, 30, STATE_AVX512},
    {"avx512vl", 7, 31, STATE_AVX512},
};
enum { E3D_INSTRUCTION_SETS = sizeof E3D_INSTRUCTIONS / sizeof *E3D_INSTRUCTIONS };

/* XCR0, or 0 if the operating system has not enabled XGETBV. */
static inline uint32_t saved_registers(uint32_t ecx1)
{
    const uint32_t osxsave = 1u << 27;
    uint32_t low, high;
    if (!(ecx1 & osxsave))
        return 0;
    __asm__ volatile("xgetbv" : "=a"(low), "=d"(high) : "c"(0));
    return low;
}

/* Reads a bit for each row of the table. CPUID takes long in a virtual machine. */
static inline uint32_t read_instructions(void)
{
    uint32_t eax, ebx7 = 0, ecx1 = 0, other, found = 0;
    __get_cpuid(1, &eax, &other, &ecx1, &other);
    __get_cpuid_count(7, 0, &eax, &ebx7, &other, &other);
    uint32_t saved = saved_registers(ecx1);
    for (int i = 0; i < E3D_INSTRUCTION_SETS; i++) {
        const e3d_instructions *row = &E3D_INSTRUCTIONS[i];
        uint32_t has = (row->leaf == 1 ? ecx1 : ebx7) >> row->bit & 1;
        found |= (has && (saved & row->state) == row->state) << i;
    }
    return found;
}

static inline int e3d_has_instructions(const char *name)
{
    const uint32_t known = 1u << 31;
    static _Atomic uint32_t answers;
    uint32_t found = atomic_load_explicit(&answers, memory_order_relaxed);
    if (!found) {
        found = read_instructions() | known;
        atomic_store_explicit(&answers, found, memory_order_relaxed);
    }
    for (int i = 0; i < E3D_INSTRUCTION_SETS; i++)
        if (strcmp(name, E3D_INSTRUCTIONS[i].name) == 0)
            return found >> i & 1;
    return 0;
}
