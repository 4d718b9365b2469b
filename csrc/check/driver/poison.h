/* Memory that nobody has written yet, filled: what reads it goes astray, and another hash tells of it.
 *
 * The build names malloc, realloc and posix_memalign anew (.ci/build_driver.py), so that all that the core and the driver
 * allocate comes through here. calloc's memory is 0 by right.
 */
#pragma once

/* From now on; 0 where the build has not named them anew. */
int poison_begin(void);
