"""The lessons of docs/course: programs to read and to run, installed as data."""
