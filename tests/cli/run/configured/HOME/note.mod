MODULE NoteModule
  PROC note()
    TPWrite "from HOME";
  ENDPROC
ENDMODULE
