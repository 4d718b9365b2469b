"""The course in a window, in a terminal or as a page of HTML: `engine3d learn`.

In: lessons, each a program that draws steps and a file with its texts in two languages. Out: three
views of the same: a picture of the page, lines of text, HTML.
"""
