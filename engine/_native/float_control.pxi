# Part of kernels_testing.pyx: the floating-point control register of the calling thread (MXCSR, FPCR).

cdef extern from *:
    """
    #include "base/machine.h"
    enum { IS_KNOWN = E3D_FLOAT_FLUSH != 0 };
    static unsigned long long float_control_read(void)
    {
        e3d_float_control control = e3d_float_control_get();
        unsigned long long value = 0;
        if (IS_KNOWN)
            memcpy(&value, &control, sizeof control);
        return value;
    }
    static void float_control_write(unsigned long long value)
    {
        e3d_float_control control;
        if (!IS_KNOWN)
            return;
        memcpy(&control, &value, sizeof control);
        e3d_float_control_set(control);
    }
    """
    enum:
        E3D_FLOAT_FLUSH
        E3D_FLOAT_ROUND_UP
    unsigned long long float_control_read() nogil
    void float_control_write(unsigned long long value) nogil

# Bits of that register: denormals become zero; rounding is towards +inf. Both are 0 where
# base/machine.h does not know the processor.
FLUSH_DENORMALS = E3D_FLOAT_FLUSH
ROUND_UP = E3D_FLOAT_ROUND_UP


def float_control() -> int:
    """The calling thread's floating-point control register (MXCSR, FPCR)."""
    return float_control_read()


def set_float_control(unsigned long long value):
    """Set the calling thread's floating-point control register."""
    float_control_write(value)
