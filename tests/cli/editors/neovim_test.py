#!/usr/bin/env python3
"""Debian's Neovim with editors/neovim and editors/vim: the indentation is that of rapidc fmt, highlighting knows strings and keywords, and
the language server gives diagnostics, hover and definition.

Usage: neovim_test.py RAPIDC
"""

import json
import pathlib
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[3]
RUNTIME = f"set runtimepath^={ROOT}/editors/vim,{ROOT}/editors/neovim"

LAYOUT = """MODULE Layout
   RECORD part
      num weight;
   ENDRECORD
   PERS num total:=0;

   !! Counts.
   PROC main()
      VAR num n;
      FOR i FROM 1 TO 3 DO
         IF i=2 THEN
            total:=total+1;
         ELSEIF i=3 THEN
            total:=0;
         ELSE
            n:=1;
         ENDIF
      ENDFOR
      WHILE n<3 DO
         IF n=1 n:=2;
         n:=n+1;
      ENDWHILE
      TEST n
      CASE 1,2:
         Stop;
      DEFAULT:
         TPWrite "none";
      ENDTEST
   ERROR
      IF ERRNO=ERR_DIVZERO THEN
         TRYNEXT;
      ENDIF
   UNDO
      total:=0;
   ENDPROC

   LOCAL FUNC num half(num n)
      RETURN n/2;
   ENDFUNC
ENDMODULE
"""

MISTAKE = """MODULE Mistake
  !! How many parts lie on the pallet.
  PERS num parts := 0;
  PROC main()
    parts := parts + "one";
    parts := missing;
  ENDPROC
ENDMODULE
"""

SESSION = """
local rapidc, file, out = '@RAPIDC@', '@FILE@', '@OUT@'
require('rapidc').setup { cmd = { rapidc, 'lsp' } }
vim.cmd('edit ' .. file)
local result = { filetype = vim.bo.filetype }
vim.wait(20000, function() return #vim.diagnostic.get(0) >= 2 end, 20)
for _, d in ipairs(vim.diagnostic.get(0)) do
  result[#result + 1] = { line = d.lnum, column = d.col, message = d.message, code = d.code, source = d.source }
end
local function ask(method, line, column)
  local answers = vim.lsp.buf_request_sync(0, method, { textDocument = { uri = vim.uri_from_bufnr(0) }, position = { line = line, character = column } }, 20000)
  for _, answer in pairs(answers or {}) do return answer.result end
end
local hover = ask('textDocument/hover', 4, 4)
local definition = ask('textDocument/definition', 4, 4)
-- correct both mistakes: the diagnostics go away
vim.api.nvim_buf_set_lines(0, 4, 6, false, { '    parts := parts + 1;' })
local clean = vim.wait(20000, function() return #vim.diagnostic.get(0) == 0 end, 20)
local file_out = io.open(out, 'w')
file_out:write(vim.fn.json_encode({ filetype = result.filetype, diagnostics = vim.list_slice(result, 1, #result), hover = hover, definition = definition, clean = clean }))
file_out:close()
vim.cmd('qall!')
"""


def nvim(folder, *arguments):
    command = ["nvim", "--headless", "-u", "NONE", "-i", "NONE", "-n", "--cmd", RUNTIME, "--cmd", "filetype plugin indent on",
               "--cmd", "syntax on", *arguments]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=60, check=False)
    return done.stdout + done.stderr


def check_indentation(folder, rapidc):
    path = folder / "layout.modx"
    path.write_text(LAYOUT, encoding="utf-8")
    formatted = subprocess.run([rapidc, "fmt", "--check", str(path)], capture_output=True, text=True, check=False)
    assert formatted.returncode == 0, f"the text is not as rapidc fmt writes it: {formatted.stdout}{formatted.stderr}"
    path.write_text("\n".join(line.strip() for line in LAYOUT.split("\n")), encoding="utf-8")
    output = nvim(folder, str(path), "-c", "normal gg=G", "-c", "wqall")
    indented = path.read_text(encoding="utf-8")
    for number, (want, have) in enumerate(zip(LAYOUT.split("\n"), indented.split("\n")), 1):
        assert want == have, f"line {number}: expected {want!r}, found {have!r}\n{output}"


def check_highlighting(folder):
    path = folder / "colours.modx"
    path.write_text('MODULE Colours\n  PROC main()\n    TPWrite "a ""b"" ! c"; ! comment\n  ENDPROC\nENDMODULE\n', encoding="utf-8")
    out = folder / "groups.json"
    places = {"keyword": (1, 1), "string": (3, 14), "inString": (3, 22), "comment": (3, 28)}
    expression = ", ".join(f"'{name}': synIDattr(synID({line}, {column}, 1), 'name')" for name, (line, column) in places.items())
    nvim(folder, str(path), "-c", f"call writefile([json_encode({{{expression}}})], '{out}')", "-c", "qall!")
    groups = json.loads(out.read_text(encoding="utf-8"))
    assert groups == {"keyword": "rapidStructure", "string": "rapidString", "inString": "rapidString", "comment": "rapidComment"}, groups


def check_server(folder, rapidc):
    path, out, script = folder / "mistake.modx", folder / "session.json", folder / "session.lua"
    path.write_text(MISTAKE, encoding="utf-8")
    script.write_text(SESSION.replace("@RAPIDC@", rapidc).replace("@FILE@", str(path)).replace("@OUT@", str(out)), encoding="utf-8")
    output = nvim(folder, "-c", f"luafile {script}")
    assert out.is_file(), output
    session = json.loads(out.read_text(encoding="utf-8"))
    assert session["filetype"] == "rapid", session
    found = [(d["line"], d["column"], d["code"], d["source"]) for d in session["diagnostics"]]
    assert len(found) == 2 and {line for line, *_ in found} == {4, 5}, found
    assert all(source == "rapidc" and code.startswith("RAP") for _, _, code, source in found), found
    hover = json.dumps(session["hover"])
    assert "PERS num parts" in hover and "How many parts" in hover, hover
    definition = session["definition"]
    first = definition[0] if isinstance(definition, list) else definition
    target = first.get("range") or first.get("targetSelectionRange")
    assert target["start"] == {"line": 2, "character": 11}, definition
    assert session["clean"] is True, session


def main():
    rapidc = str(pathlib.Path(sys.argv[1]).resolve())
    assert shutil.which("nvim"), "Neovim is not installed: apt-get install neovim"
    with tempfile.TemporaryDirectory(prefix="rapidc-neovim-") as name:
        folder = pathlib.Path(name)
        for part in ("indentation", "highlighting", "server"):  # modules of one folder are one program
            (folder / part).mkdir()
        check_indentation(folder / "indentation", rapidc)
        check_highlighting(folder / "highlighting")
        check_server(folder / "server", rapidc)
    print("indentation, highlighting, diagnostics, hover, definition: as expected")
    return 0


if __name__ == "__main__":
    sys.exit(main())
