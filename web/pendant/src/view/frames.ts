import { CylinderGeometry, Group, Mesh, MeshBasicMaterial, SphereGeometry } from "three";

const colours = ["#e5484d", "#3fae5a", "#3b82f6"];

/** Three arrows x, y, z in red, green, blue; size in metres. */
export function frameAxes(size: number): Group {
    const group = new Group();
    colours.forEach((colour, axis) => {
        const material = new MeshBasicMaterial({ color: colour });
        const shaft = new Mesh(new CylinderGeometry(size * 0.028, size * 0.028, size * 0.8, 10), material);
        const tip = new Mesh(new CylinderGeometry(0, size * 0.075, size * 0.2, 14), material);
        shaft.position.y = size * 0.4;
        tip.position.y = size * 0.9;
        const arrow = new Group();
        arrow.add(shaft, tip);
        if (axis === 0) arrow.rotation.z = -Math.PI / 2;
        if (axis === 2) arrow.rotation.x = Math.PI / 2;
        group.add(arrow);
    });
    const centre = new Mesh(new SphereGeometry(size * 0.05, 14, 10), new MeshBasicMaterial({ color: "#f4f6f8" }));
    group.add(centre);
    return group;
}

export function disposeTree(group: Group): void {
    group.traverse((object) => {
        if (!(object instanceof Mesh)) return;
        object.geometry.dispose();
        for (const material of [object.material].flat()) material.dispose();
    });
    group.removeFromParent();
}
