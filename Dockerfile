# A clone with everything that its two commands need: the image is built by `make demo`, and a container runs `make test`.
#   docker build -t robosmi .
#   docker run --rm robosmi                          # make test
#   docker run --rm -it robosmi .venv/bin/robosmi demo --no-browser
# CI has no Docker, so no run of it builds this image.
FROM python:3.12-bookworm
ENV PIP_CONSTRAINT=/robosmi/constraints.txt LANG=C.UTF-8
WORKDIR /robosmi
COPY .ci/system-packages .ci/npm-packages .ci/
RUN sh .ci/system-packages && sh .ci/npm-packages
COPY . .
RUN make demo
CMD ["make", "test"]
