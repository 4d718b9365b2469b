# Part of kernels_testing.pyx: the floating-point control register of the calling thread (MXCSR, FPCR).

cdef extern from *:
    """
    #include <stdint.h>
    #if defined(__x86_64__) || defined(__i386__)
    #include <xmmintrin.h>
    enum { FLOAT_CONTROL_FLUSH = 0x8040, FLOAT_CONTROL_ROUND_UP = 0x4000 };
    static uint64_t float_control_read(void) { return _mm_getcsr(); }
    static void float_control_write(uint64_t value) { _mm_setcsr((unsigned)value); }
    #elif defined(__aarch64__)
    enum { FLOAT_CONTROL_FLUSH = 1 << 24, FLOAT_CONTROL_ROUND_UP = 1 << 22 };
    static uint64_t float_control_read(void)
    {
        uint64_t value;
        __asm__ volatile("mrs %0, fpcr" : "=r"(value));
        return value;
    }
    static void float_control_write(uint64_t value) { __asm__ volatile("msr fpcr, %0" : : "r"(value)); }
    #else
    enum { FLOAT_CONTROL_FLUSH = 0, FLOAT_CONTROL_ROUND_UP = 0 };
    static uint64_t float_control_read(void) { return 0; }
    static void float_control_write(uint64_t value) { (void)value; }
    #endif
    """
    enum:
        FLOAT_CONTROL_FLUSH
        FLOAT_CONTROL_ROUND_UP
    unsigned long long float_control_read() nogil
    void float_control_write(unsigned long long value) nogil

# Bits of the calling thread's floating-point control register: denormals become zero; rounding is
# towards +inf. Both are 0 where this file does not know the processor.
FLUSH_DENORMALS = FLOAT_CONTROL_FLUSH
ROUND_UP = FLOAT_CONTROL_ROUND_UP


def float_control():
    """The calling thread's floating-point control register (MXCSR, FPCR)."""
    return float_control_read()


def set_float_control(unsigned long long value):
    """Set the calling thread's floating-point control register."""
    float_control_write(value)
