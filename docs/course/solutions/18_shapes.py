"""A solution of the checked exercise of lesson 18, shapes."""

bands = 2
while 2 * (2 * bands) * (bands - 1) <= 1000:  # 2 n (m - 1) triangles
    bands += 1
print(2 * bands)
