# Part of loaders.pyx: memory that C allocated, or the bytes of a file, as Python's.
#
# In:  sizes, or what C hands over.
# Out: arrays over memory in large pages; once frozen, nobody can write to it any more, whatever flags are set.

cdef extern from "base/large_pages.h":
    void *e3d_large_memory(size_t bytes) nogil
    void e3d_want_large_pages(void *memory, size_t bytes) nogil
    void e3d_populate(void *memory, size_t bytes) nogil
    size_t E3D_LARGE_ROOM

cdef size_t PAGE = 1 << 12, LARGE_PAGE = 1 << 21


def read_bytes(readinto: Callable[[memoryview], int], Py_ssize_t size) -> bytes:
    """Read at most ``size`` bytes by ``readinto(view) -> count`` until it says 0.

    As `io.FileIO.read` does, but into large pages: many small ones take longer to come than the
    bytes of a file.
    """
    data = PyBytes_FromStringAndSize(NULL, size)
    cdef char *start = PyBytes_AsString(data)
    e3d_want_large_pages(start, size)
    cdef Py_ssize_t done = 0, count
    while done < size:
        count = readinto(PyMemoryView_FromMemory(start + done, size - done, PyBUF_WRITE))
        if count == 0:
            return data[:done]
        done += count
    return data


cdef class OwnedMemory:
    """Memory that free() takes back; read-only once it is frozen."""

    cdef void *data
    cdef Py_ssize_t size
    cdef readonly bint is_frozen

    def __dealloc__(self):
        free(self.data)

    def __getbuffer__(self, Py_buffer *buffer, int flags):
        PyBuffer_FillInfo(buffer, self, self.data, self.size, self.is_frozen, flags)


cdef object owned(void **data, size_t count, object dtype):
    """An array over what C allocated, which it frees; `data` is taken over."""
    if data[0] == NULL or count == 0:
        return np.empty(0, dtype)
    cdef OwnedMemory memory = OwnedMemory.__new__(OwnedMemory)
    memory.data, memory.size = data[0], count * <size_t>dtype.itemsize
    data[0] = NULL
    return np.ndarray((count,), dtype, memory)


def large_array(shape: tuple[int, ...], dtype: DTypeLike) -> NDArray[Any]:
    """Return an array of any content, in large pages where it is large."""
    dtype = np.dtype(dtype)
    cdef size_t size = dtype.itemsize * int(np.prod(shape, dtype=object)), large
    if size < LARGE_PAGE:
        return np.empty(shape, dtype)
    cdef void *data = e3d_large_memory(size)
    if data == NULL:
        raise MemoryError
    # Small pages come faster all at once; where the system cannot, they come one by one.
    large = size // LARGE_PAGE * LARGE_PAGE if size >= E3D_LARGE_ROOM else PAGE
    if size > large:
        e3d_populate(<char *>data + large - (<size_t>data + large) % PAGE, size - large)
    return owned(&data, size, np.dtype(np.uint8)).view(dtype).reshape(shape)


cdef class SealedMemory:
    """The memory of an array, for reading: NumPy asks it before it lets anybody write."""

    cdef Py_buffer held

    def __dealloc__(self):
        PyBuffer_Release(&self.held)

    def __getbuffer__(self, Py_buffer *buffer, int flags):
        PyBuffer_FillInfo(buffer, self, self.held.buf, self.held.len, True, flags)


cdef object NDARRAY = np.ndarray
cdef Py_ssize_t SMALL = 1024  # bytes: to copy them takes less time than to lend them


def frozen(array: NDArray[Any]) -> NDArray[Any]:
    """Return an array that nobody can write to: over the memory of this one, if only the caller has it.

    A flag alone would not do, because whoever has an array can set its flag again.
    """
    cdef SealedMemory memory
    cdef Py_ssize_t size
    owner = array
    while isinstance(owner.base, NDARRAY):
        owner = owner.base
    base = owner.base
    if isinstance(base, OwnedMemory):
        (<OwnedMemory>base).is_frozen = True
        owner = array
        while isinstance(owner, NDARRAY):
            owner.setflags(write=False)
            owner = owner.base
        return array
    if isinstance(base, (SealedMemory, bytes)):
        return array
    size = array.nbytes
    if size <= SMALL:
        return NDARRAY(array.shape, array.dtype, array.tobytes())
    if base is not None or not array.flags.c_contiguous:
        array = np.array(array, order="C")
    memory = SealedMemory.__new__(SealedMemory)
    PyObject_GetBuffer(array, &memory.held, PyBUF_SIMPLE)
    return NDARRAY(array.shape, array.dtype, memory)


def is_frozen(array: np.ndarray) -> bool:
    """Tell whether nobody can write to an array's memory, nor allow it."""
    if array.flags.writeable:
        return False
    base = array.base
    while isinstance(base, NDARRAY):
        base = base.base
    if isinstance(base, OwnedMemory):
        return bool((<OwnedMemory>base).is_frozen)
    return isinstance(base, (SealedMemory, bytes))


def exchange(dict held, dict expected, dict fresh) -> bool:
    """Update a dict unless it holds other values than expected, as one step; tell whether.

    Neither another thread nor a signal handler comes in between.
    """
    if held.keys() != expected.keys():
        return False
    for key, value in expected.items():
        if held[key] is not value:
            return False
    held.update(fresh)
    return True
