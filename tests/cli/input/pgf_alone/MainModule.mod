MODULE MainModule
  PROC main()
    TPWrite "begin";
    openGripper;
    TPWrite "speed "\Num:=cellSpeed;
    TPWrite "end";
  ERROR
    IF ERRNO=ERR_REFUNKPRC TPWrite "no procedure";
    IF ERRNO=ERR_REFUNKDAT TPWrite "no data";
    TRYNEXT;
  ENDPROC
ENDMODULE
