// what the sensors say
int distance(); // in cm
int level(void);
