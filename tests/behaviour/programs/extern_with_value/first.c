extern int mode = 3;
extern int level = 70000, peak;
int peak = 4;
int next(void) { return mode + level + peak; }
