"""A solution of the checked exercise of lesson 14, cube."""

bits = [1 << axis for axis in range(5)]
print(len([(i, i | bit) for i in range(32) for bit in bits if not i & bit]))
