MODULE AddInNames
  VAR num taken := 0;
  PROC main()
    VAR num state := 0;
    state := 1;
    Search_Groove p10, p20, v100, tool0;
    state := 2;
    PDispAdd p10, p20, tool0;
    state := 3;
    EventLog "closed";
    state := 4;
    GetItmTgt 1, target;
    state := 5;
    DaActProc 1;
    state := 6;
    FCCalib load0;
    state := 7;
    FCPress1LStart p10, v30, \Fz:=200, 50, z30, tool0;
    state := 8;
    taken := FCGetForce();
    TPWrite "end";
  ERROR
    IF ERRNO = ERR_REFUNKPRC OR ERRNO = ERR_REFUNKFUN OR ERRNO = ERR_REFUNKDAT THEN
      TPWrite "state "\Num:=state;
      TRYNEXT;
    ENDIF
    RAISE;
  ENDPROC
  CONST robtarget p10 := [[500,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p20 := [[600,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR itmtgt target;
ENDMODULE
