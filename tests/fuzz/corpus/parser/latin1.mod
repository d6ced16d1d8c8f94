MODULE m
  VAR string הצ := "grüße \07";
  ! י
ENDMODULE
