MODULE caller
  VAR num n;
  PROC main()
    WHILE n<2 DO
      n:=n+1;
      Continue;
      TPWrite "after" \Num:=n;
    ENDWHILE
    Break;
    TPWrite "end";
  ENDPROC
ENDMODULE
