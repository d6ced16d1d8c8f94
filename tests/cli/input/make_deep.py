"""Writes a module with an expression nested 100,000 parentheses deep."""
import sys

with open(sys.argv[1], "w", encoding="utf-8") as file:
    file.write("MODULE Deep\n  PROC main()\n    reg1 := " + "(" * 100000 + "1" + ")" * 100000 + ";\n")
    file.write("  ENDPROC\nENDMODULE\n")
