import { Connection } from "./api/connection";
import { Model } from "./api/model";
import { startTheme } from "./shell/theme";
import { Shell } from "./shell/shell";
import { showError } from "./ui/notices";

const scheme = location.protocol === "https:" ? "wss:" : "ws:";
const connection = new Connection(`${scheme}//${location.host}/api`);
const model = new Model(connection);

startTheme();
const shell = new Shell(document.getElementById("app") as HTMLElement, model);
connection.onStatus = (status) => shell.showStatus(status);
connection.onReady = (hello) => {
    shell.showProduct(hello.product);
    model.load().catch(showError);
};
// for measurements: the tests and anyone at the console
Object.assign(window, { rapidcStatistics: () => shell.statistics });
connection.open();
