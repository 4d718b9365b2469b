/* The other way of DEFLATE (RFC 1951), as plainly as can be: what the PNG target reads its files with. */
#pragma once

#include <stddef.h>
#include <stdint.h>

/* Unpacks a stream that must give exactly `count` bytes. Returns how many bytes of it were read; SIZE_MAX if it is
 * not sound, or refers to more than `window` bytes before. */
size_t inflate_stream(const uint8_t *bytes, size_t size, uint8_t *to, size_t count, size_t window);
