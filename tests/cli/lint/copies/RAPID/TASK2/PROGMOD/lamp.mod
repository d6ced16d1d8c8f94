MODULE lamp
  PROC lampMain()
    blink 2;
    WaitTime 1;
  ENDPROC

  PROC forgotten(num n)
    TPWrite ValToStr(n);
  ENDPROC
ENDMODULE
