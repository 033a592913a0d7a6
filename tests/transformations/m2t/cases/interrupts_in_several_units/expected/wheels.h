void forward(int32_t speed);
