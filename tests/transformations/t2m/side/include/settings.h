#define EYE 4
