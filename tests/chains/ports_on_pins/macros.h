#define FRONT (REAR + 1)
#define REAR 24
