MODULE callee
  PROC Continue()
    TPWrite "continue";
  ENDPROC
  PROC break()
    TPWrite "break";
  ENDPROC
ENDMODULE
