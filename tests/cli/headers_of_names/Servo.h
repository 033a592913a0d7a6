#define QD 6
