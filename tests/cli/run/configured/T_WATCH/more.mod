MODULE MoreModule
  PROC inFolder()
    Incr level;
  ENDPROC
ENDMODULE
