/* stream: a row of pixels to the picture, which this core won't read again. */

/* Past the caches, so that memory isn't read first; where the row isn't made of whole vectors, of 16 bytes each or not at all. */
static void kernel_stream(void *to, const void *from, size_t bytes)
{
    if (((uintptr_t)to | bytes) % sizeof(vi32)) {
        e3d_stream(to, from, bytes);
        return;
    }
    for (size_t at = 0; at < bytes; at += sizeof(vi32))
        v_streami((char *)to + at, v_loadi((const char *)from + at));
}
