%%%
  VERSION:1
  LANGUAGE:ENGLISH
%%%

MODULE Legacy
  !@ test: run
  !@ manual: 1.1.3
  PROC main()
    TPWrite "from .mod";
    fromSys;
  ENDPROC
ENDMODULE
