void forward(int speed);
void turn(void);
