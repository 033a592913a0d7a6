void forward(int speed);
