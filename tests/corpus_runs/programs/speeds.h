#define FORWARD 64
