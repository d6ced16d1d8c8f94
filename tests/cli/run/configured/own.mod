MODULE OwnModule
  PROC own()
    TPWrite "own of the motion task";
  ENDPROC
ENDMODULE
