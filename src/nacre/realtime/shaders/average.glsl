// A frame, added to the mean of those before it, in its place of the whole picture.
layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) uniform sampler2D frame;
layout(binding = 1, rgba32f) uniform image2D picture;
uniform int column;   // of the picture, where the frame begins
uniform float share;  // of this frame in the mean; 1: the first
uniform float weight; // of the frame's sample

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy), place = pixel + ivec2(column, 0);
    if (any(greaterThanEqual(pixel, textureSize(frame, 0)))) return;
    if (any(greaterThanEqual(place, imageSize(picture)))) return;
    vec4 value = texelFetch(frame, pixel, 0) * vec4(vec3(weight), 1);
    if (share < 1) value = mix(imageLoad(picture, place), value, share);
    imageStore(picture, place, value);
}
