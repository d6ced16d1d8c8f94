" .sys and .prg are other things, too: only with a module inside.
function! s:ByContent() abort
  if join(getline(1, 20), "\n") =~? '\%(^\|\n\)\s*\%(%%%\|MODULE\s\+\h\)' | setlocal filetype=rapid | endif
endfunction
autocmd BufRead,BufNewFile *.modx,*.sysx setlocal filetype=rapid
autocmd BufRead,BufNewFile *.mod,*.MOD,*.sys,*.SYS,*.prg,*.PRG call s:ByContent()
