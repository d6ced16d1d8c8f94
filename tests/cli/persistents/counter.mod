MODULE Counter
  ! grüße: nothing but values may change
  PERS num count := 0041;   ! as it was
  PERS num unchanged:=1.50;
	LOCAL PERS string name := "alt" ;
  TASK PERS bool flag:=FALSE;
  PERS robtarget p1 := [[100,200.50,300],   ! position
     [1,0,0,0], [0,0,0,0], [9E9,9E+09,9E9,9E9,9E9,9E9]];
  PERS dnum third:=1;
  PERS num tiny :=-1;
  PERS num list{2,2} := [ [1,2], [3,4] ]; ! two by two
  PERS num free;
  PERS num none:=7;
  VAR num plain := 5;
  CONST num fixed := 5;

  PROC main()
    count := count + 1;
    name := "grün ""x"" \\ \07";
    flag := TRUE;
    p1.trans.x := 0.1;
    p1.trans.z := 1 / 3;
    p1.extax.eax_a := -12.5;
    third := 1 / 3;
    tiny := 1E-7;
    list{2,1} := 8388608;
    list{2,2} := 123456.78;
    free := 3;
    none := none + 0;
    plain := 6;
    TPWrite "count " \Num:=count;
  ENDPROC
ENDMODULE
