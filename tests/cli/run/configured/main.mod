MODULE MainModule
  PERS num ready := 0;
  PROC main()
    Incr level;
    own;
    ready := 1;
    WaitUntil ready = 2;
    TPWrite "robot sees " \Num:=level;
    Load \Dynamic, "HOME:/note.mod";
    %"note"%;
  ENDPROC
ENDMODULE
