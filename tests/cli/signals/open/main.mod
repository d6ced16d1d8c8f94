MODULE MainModule
  PROC main()
    TPWrite "begin";
    Set doGrip;
    IF soTouch = 0 TPWrite "untouched";
    TPWrite "end";
  ERROR
    IF ERRNO = ERR_REFUNKDAT TPWrite "no data";
    IF ERRNO = ERR_NO_ALIASIO_DEF TPWrite "no signal";
    TRYNEXT;
  ENDPROC
ENDMODULE
