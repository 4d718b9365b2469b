/* Memory that nobody has written yet, filled. */
#ifdef malloc
#define POISONS
#undef malloc
#undef realloc
#undef posix_memalign
#endif

#include "check/driver/poison.h"

#ifdef POISONS

#include <malloc.h>
#include <stdlib.h>
#include <string.h>

void *poison_malloc(size_t bytes);
void *poison_realloc(void *old, size_t bytes);
int poison_posix_memalign(void **memory, size_t alignment, size_t bytes);

static int poisons;

int poison_begin(void) { return poisons = 1; }

/* Floats become NaN or 3.4e38, and integers -1 or 2,139,062,143: by the size, so that a run is like the next. */
static void fill(void *memory, size_t bytes)
{
    if (poisons && memory)
        memset(memory, bytes / 64 % 2 ? 0xFF : 0x7F, bytes);
}

void *poison_malloc(size_t bytes)
{
    void *memory = malloc(bytes);
    fill(memory, bytes);
    return memory;
}

/* Elsewhere: what is added would not be known otherwise. */
void *poison_realloc(void *old, size_t bytes)
{
    if (!poisons)
        return realloc(old, bytes);
    void *memory = poison_malloc(bytes);
    size_t room = old ? malloc_usable_size(old) : 0;
    if (memory && old) {
        memcpy(memory, old, room < bytes ? room : bytes);
        free(old);
    }
    return memory;
}

int poison_posix_memalign(void **memory, size_t alignment, size_t bytes)
{
    int error = posix_memalign(memory, alignment, bytes);
    if (!error)
        fill(*memory, bytes);
    return error;
}

#else

int poison_begin(void) { return 0; }

#endif
