"""A solution of the checked exercise of lesson 17, light falloff."""

e = 0.8 / 0.7**2  # the cosine is 1
print(round(255 * e) % 256)
