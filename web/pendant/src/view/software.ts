/**
 * The processor draws the pictures, not graphics hardware. Smoothing of edges and materials that reflect take nine tenths of the time
 * there; what replaces them looks nearly the same.
 */
export const drawsInSoftware = findRenderer();

function findRenderer(): boolean {
    const context = document.createElement("canvas").getContext("webgl2");
    if (!context) return true;
    const details = context.getExtension("WEBGL_debug_renderer_info");
    const name = String(context.getParameter(details ? details.UNMASKED_RENDERER_WEBGL : context.RENDERER));
    context.getExtension("WEBGL_lose_context")?.loseContext();
    return /swiftshader|llvmpipe|software|basic render/i.test(name);
}
