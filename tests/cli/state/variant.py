"""variant.py FROM TO [OLD NEW]...: copies a module with some texts replaced, each of which must be there."""

import sys

with open(sys.argv[1], encoding="utf-8") as file:
    text = file.read()
for old, new in zip(sys.argv[3::2], sys.argv[4::2]):
    assert old in text, old
    text = text.replace(old, new, 1)
with open(sys.argv[2], "w", encoding="utf-8") as file:
    file.write(text)
