// Records of RAPID's geometry.
typedef struct {
    float x, y, z;
} pos;
typedef struct {
    float q1, q2, q3, q4;
} orient;
typedef struct {
    pos trans;
    orient rot;
} pose;
