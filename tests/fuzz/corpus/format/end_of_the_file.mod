MODULE unused
  PROC mainm count;
    TPWrite "hello";
  ENDPROC
ENDM§ODULE unused
  PROC mainm count;
    TPWrite "hello";
  END