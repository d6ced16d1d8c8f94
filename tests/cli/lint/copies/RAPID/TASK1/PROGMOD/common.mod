MODULE common
  RECORD order
    num number;
    num parts;
  ENDRECORD

  PERS num lampState := 0;

  PROC count(num n)
    VAR order o;
    o.number := n;
    TPWrite ValToStr(o);
  ENDPROC

  PROC blink(num times)
    lampState := times;
  ENDPROC

  FUNC num twice(num n)
    RETURN 2 * n;
  ENDFUNC
ENDMODULE
