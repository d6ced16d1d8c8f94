MODULE MainModule
  VAR secrettype kept;

  PROC main()
    VAR secrettype own;
    TPWrite "begin";
    secretMove kept,[1,2],"x";
    own:=kept;
    own.part:=1;
    IF secretReady(kept) TPWrite "never";
    TPWrite "end";
  ERROR
    IF ERRNO=ERR_REFUNKPRC TPWrite "no procedure";
    IF ERRNO=ERR_REFUNKDAT TPWrite "no data";
    IF ERRNO=ERR_REFUNKFUN TPWrite "no function";
    TRYNEXT;
  ENDPROC
ENDMODULE
