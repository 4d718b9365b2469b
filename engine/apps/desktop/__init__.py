"""What the programs of a desktop share: the user's folders, the files that were opened lately."""
