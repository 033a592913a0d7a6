extern float plan[2];
extern int shared;
void make(float *to, unsigned char *from);
int other(void);
