/* Rows that are equal, among few. */
#pragma once

#include "io/loaders/row_hash.h"

e3d_row_seeds e3d_random_seeds(void);

/* Whether two rows are equal; for few rows, since each distinct one takes memory. Like e3d_rows_repeat(). */
int e3d_few_rows_repeat(const e3d_rows *rows);
