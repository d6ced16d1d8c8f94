MODULE Lamp
  PROC lampMain()
    WaitUntil nPlaced>=4;
    sStep{1}:="seen by ";
    sStep{2}:="lamp";
    bDone:=TRUE;
    WaitUntil NOT bDone;
  ENDPROC
ENDMODULE
