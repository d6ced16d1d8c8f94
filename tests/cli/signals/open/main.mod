MODULE MainModule
  PROC main()
    TPWrite "begin";
    Set doGrip;
    IF soTouch = 0 TPWrite "untouched";
    TPWrite "end";
  ERROR
    IF ERRNO = ERR_REFUNKDAT TPWrite "no data";
    TRYNEXT;
  ENDPROC
ENDMODULE
