/* The hash of what the driver draws. */
#pragma once

#include <stddef.h>
#include <stdint.h>

/* FNV-1a: the hash of some bytes after those that gave `hash`. */
static const uint64_t HASH_START = 0xCBF29CE484222325u;
static inline uint64_t hash_bytes(uint64_t hash, const uint8_t *bytes, size_t count)
{
    for (size_t i = 0; i < count; i++)
        hash = (hash ^ bytes[i]) * 0x100000001B3u;
    return hash;
}
